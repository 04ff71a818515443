#include "tools/run_folder/input_files.h"

#include "caches/layouts/layout.h"
#include "caches/recorded/recording.h"
#include "scenes/schema.h"
#include "tools/base/errors.h"
#include "tools/base/fingerprint.h"

#include <fmt/core.h>

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char *kOnto = "texture.onto.files", *kExemplar = "texture.exemplar";

// Files behind one key; a single one is a sequence without a place for its number.
struct Input {
  std::string key;
  sim::MeshSequence files;
  bool sequence = false;
};

// Goes through the schema, so that a key that is new there is known here.
class Collector : public scenes::Visitor {
 public:
  using Limits = scenes::Limits;
  using Need = scenes::Need;
  using Vec3d = scenes::Vec3d;
  using Words = std::vector<std::string>;

  void flag(const std::string&, bool&) override {}
  void seed(const std::string&, std::uint64_t&) override {}
  void number(const std::string&, double&, const Limits&, Need) override {}
  void text(const std::string&, std::string&) override {}
  void vector(const std::string&, Vec3d&, const Limits&, Need) override {}
  void integers(const std::string&, std::vector<int>&, const Limits&) override {}
  void pixels(const std::string&, int&, int&, const Limits&) override {}
  void choice(const std::string&, int&, const Words&) override {}
  int alternative(int current, const Words&, Need) override { return current; }
  void absent(const std::string&) override {}

  void file(const std::string& key, fs::path& value, const Words&) override { add(key, value, false); }
  void files(const std::string& key, fs::path& value, const Words&) override { add(key, value, true); }
  void picture(const std::string& key, fs::path& value, texture::AnimationOptions& sequence) override {
    add(key, sequence.pattern.empty() ? value : sequence.pattern, !sequence.pattern.empty());
    if (sequence.pattern.empty()) return;
    inputs.back().files.first = sequence.first;
    inputs.back().files.last = sequence.first + int(sequence.files.size()) - 1;
  }
  void path(const std::string&, fs::path&) override {}
  // The numbers of a sequence stand behind its name in the same table.
  void integer(const std::string& key, int& value, const Limits&, Need) override {
    if (inputs.empty() || !inputs.back().sequence || inputs.back().key != dotted("files")) return;
    if (key == "first") inputs.back().files.first = value;
    if (key == "last") inputs.back().files.last = value;
  }

  void enter(const std::string& key, Need) override { m_open.push_back(key); }
  std::size_t enterList(const std::string& key, std::size_t size, Need) override {
    m_open.push_back(key);
    return size;
  }
  void enterMember(std::size_t index) override { m_open.push_back(std::to_string(index)); }
  void leave() override { m_open.pop_back(); }

  std::vector<Input> inputs;

 private:
  std::string dotted(const std::string& key) const {
    std::string whole;
    for (const std::string& part : m_open) whole += part + ".";
    return whole + key;
  }
  void add(const std::string& key, const fs::path& value, bool sequence) {
    if (!value.empty()) inputs.push_back({dotted(key), {.files = value}, sequence});
  }

  Words m_open;
};

std::vector<Input> inputsOf(scenes::Scene scene) {
  Collector collector;
  scenes::describe(collector, scene);
  // One a frame: how many, no key says. Those of frames that nobody asks for need not be there.
  for (Input& input : collector.inputs) {
    if (input.key != kOnto) continue;
    int count = 0;
    while (count < scene.frames && fs::exists(input.files.fileOf(count))) ++count;
    input.files.last = input.files.first + std::max(1, count) - 1;
  }
  return std::move(collector.inputs);
}

Fingerprint contentOf(const fs::path& file) {
  try {
    return fingerprintOf(file);
  } catch (const std::system_error& error) {
    throw UsageError(error.what());
  }
}

Fingerprint contentOf(const sim::MeshSequence& files) {
  if (files.count() == 1) return contentOf(files.fileOf(0));
  Fingerprint all;
  std::string hashes;
  for (int n = 0; n < files.count(); ++n) {
    const Fingerprint one = contentOf(files.fileOf(n));
    all.bytes += one.bytes;
    hashes += one.hash;
  }
  all.hash = hashOf(hashes);
  return all;
}

// Frames of the cache that do not change any more: without those that a program still writes.
int wholeFrames(const scenes::Scene& scene) {
  if (!scene.files.follow) return scene.frames;
  return std::min(scene.frames, caches::recognize(scene.files).frames() - 1);
}

// The cache's files of that many frames. They may be large: told apart by names, sizes and times of change.
Fingerprint contentOfCache(const scenes::Scene& scene, int frames) {
  std::vector<fs::path> files;
  if (caches::isRecording(scene.files.path)) {
    for (int frame = 1; frame <= frames; ++frame)
      files.push_back(caches::recordedFrame(scene.files.path, frame));
  } else {
    const caches::Layout layout = caches::recognize(scene.files);
    for (int number = layout.first; number < layout.first + frames; ++number)
      for (const caches::NumberedFiles* source :
           {&layout.surface, &layout.velocity, &layout.config, &layout.blur})
        if (const auto file = source->byNumber.find(number); file != source->byNumber.end())
          files.push_back(file->second);
  }
  Fingerprint all;
  std::string text;
  for (const fs::path& file : files) {
    std::error_code unknown;
    const std::uintmax_t bytes = fs::file_size(file, unknown);
    if (unknown) throw UsageError(fmt::format("{}: cannot be read ({})", file.string(), unknown.message()));
    all.bytes += bytes;
    text += fmt::format("{} {} {}\n", file.filename().string(), bytes,
                        fs::last_write_time(file, unknown).time_since_epoch().count());
  }
  all.hash = hashOf(text);
  return all;
}

bool isOutOfFiles(const scenes::Scene& scene) {
  return scene.motion.flow == sim::MotionKind::files;
}

Fingerprint fingerprintIn(const Json& entry) {
  return {entry.value("bytes", std::uint64_t{0}), entry.value("hash", "")};
}

}  // namespace

Json contentsOf(const scenes::Scene& scene) {
  Json contents = Json::object();
  for (const auto& [key, files, sequence] : inputsOf(scene)) {
    const Fingerprint content = contentOf(files);
    Json& entry = contents[key];
    entry["file"] = fs::absolute(files.files).lexically_normal().generic_string();
    if (sequence) {
      entry["first"] = files.first;
      entry["count"] = files.count();
    }
    entry["bytes"] = content.bytes;
    entry["hash"] = content.hash;
  }
  if (isOutOfFiles(scene)) {
    const int frames = wholeFrames(scene);
    const Fingerprint content = contentOfCache(scene, frames);
    contents["files.path"] = {{"file", fs::absolute(scene.files.path).lexically_normal().generic_string()},
                              {"frames", frames},
                              {"bytes", content.bytes},
                              {"hash", content.hash}};
  }
  return contents;
}

std::string contentDifference(const Json& before, const Json& current, const scenes::Scene& scene) {
  for (auto& [key, files, sequence] : inputsOf(scene)) {
    if (!before.contains(key) || !current.contains(key)) continue;
    const Json& then = before.at(key);
    const int count = then.value("count", 1);
    Fingerprint now = fingerprintIn(current.at(key));
    if (sequence && count != files.count() && key != kExemplar) {
      // As many as there were: more frames have more of them.
      files.last = files.first + std::max(1, count) - 1;
      now = contentOf(files);
    }
    if (now != fingerprintIn(then))
      return fmt::format("{} ({}) has changed since the run began", files.files.string(), key);
  }
  if (isOutOfFiles(scene) && before.contains("files.path")) {
    const Json& then = before.at("files.path");
    // As many as there were: more frames have more files.
    if (contentOfCache(scene, then.value("frames", scene.frames)) != fingerprintIn(then))
      return fmt::format("{} (files.path) has changed since the run began", scene.files.path.string());
  }
  return {};
}

}  // namespace fluidtex::tools
