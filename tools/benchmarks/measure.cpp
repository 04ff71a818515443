#include "tools/benchmarks/measure.h"

#include <nlohmann/json.hpp>

#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <filesystem>

namespace fluidtex::benchmarks {
namespace {

struct Kept {
  std::string name, quantity;
  double value;
};

std::vector<Kept>& kept() {
  static std::vector<Kept> all;
  return all;
}

constexpr const char* kPeer = "/peer:";

double secondsOf(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

// Runs this very program with these arguments and gives what it prints; empty where it fails.
std::string runSelf(const std::string& arguments) {
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  FILE* pipe = popen(("\"" + program + "\" " + arguments).c_str(), "r");
  if (pipe == nullptr) return {};
  std::string text;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  return pclose(pipe) == 0 ? text : std::string();
}

}  // namespace

double processorSeconds() {
  return secondsOf(CLOCK_PROCESS_CPUTIME_ID);
}

double wallSeconds() {
  return secondsOf(CLOCK_MONOTONIC);
}

double peakBytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

void keep(const std::string& name, const std::string& quantity, double value) {
  // Of repetitions the last one counts.
  for (Kept& other : kept()) {
    if (other.name == name && other.quantity == quantity) {
      other.value = value;
      return;
    }
  }
  kept().push_back({name, quantity, value});
}

void printRatios() {
  bool any = false;
  for (const Kept& peer : kept()) {
    const std::size_t at = peer.name.find(kPeer);
    if (at == std::string::npos) continue;
    for (const Kept& ours : kept()) {
      if (ours.name != peer.name.substr(0, at) || ours.quantity != peer.quantity) continue;
      if (!any) std::printf("\n%-36s %-18s %12s %12s   %s\n", "", "", "ours", "peer", "peer / ours");
      any = true;
      std::printf("%-36s %-18s %12.4g %12.4g   %.2f\n", peer.name.c_str(), peer.quantity.c_str(), ours.value,
                  peer.value, peer.value / ours.value);
    }
  }
}

std::optional<double> measureMemory(benchmark::State& state, const std::string& arguments,
                                    const std::string& unit) {
  const auto told = nlohmann::json::parse(runSelf(arguments), nullptr, false);
  if (!told.is_object()) {
    state.SkipWithError("the program that measures memory failed");
    return {};
  }
  const double bytes = told.at("bytes"), count = told.at(unit + "s");
  state.SetIterationTime(told.at("seconds").get<double>());
  state.counters["bytes_per_" + unit] = bytes / count;
  state.counters["peak_MB"] = bytes / 1e6;
  state.counters[unit + "s"] = count;
  return bytes / count;
}

}  // namespace fluidtex::benchmarks
