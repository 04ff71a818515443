#include "tools/frames/progress.h"

#include "tools/base/console.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {
namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);

std::string bar(double share, int cells) {
  const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * cells + 0.5);
  std::string text(static_cast<std::size_t>(cells), '.');
  text.replace(0, static_cast<std::size_t>(full), static_cast<std::size_t>(full), '#');
  return '[' + text + ']';
}

}  // namespace

std::string humanDuration(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

Progress::Progress(int first, int last, bool quiet)
    : m_first(first), m_last(last), m_quiet(quiet), m_start(Clock::now()) {}

Progress::~Progress() {
  clearStatus();
}

std::string Progress::timeLeft() const {
  if (m_done == 0) return "";
  const double perFrame = std::chrono::duration<double>(Clock::now() - m_start).count() / m_done;
  return humanDuration(perFrame * (m_last - m_first + 1 - m_done)) + " left";
}

void Progress::update(int frame, const std::string& stage, double part) {
  if (m_quiet || !drawsStatus() || Clock::now() - m_drawn < kRedraw) return;
  m_drawn = Clock::now();
  const double share = static_cast<double>(m_done) / std::max(1, m_last - m_first + 1);
  const std::string words =
      fmt::format("frame {}/{}  {:<10} {:3.0f}%  {}", frame, m_last, stage, 100.0 * part, timeLeft());
  const int cells = std::clamp(statusWidth() - static_cast<int>(words.size()) - 4, 0, 40);
  showStatus(bar(share, cells) + " " + words);
}

void Progress::frameDone(int frame, const std::string& summary) {
  ++m_done;
  if (!m_quiet && !drawsStatus()) say("frame {}/{}: {}; {}\n", frame, m_last, summary, timeLeft());
}

}  // namespace fluidtex::tools
