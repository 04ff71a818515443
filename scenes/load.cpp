#include "scenes/checks.h"
#include "scenes/complete.h"
#include "scenes/document.h"
#include "scenes/faults.h"
#include "scenes/reader.h"
#include "scenes/scene.h"
#include "scenes/schema.h"
#include "scenes/source.h"
#include "scenes/writer.h"

#include <algorithm>
#include <array>
#include <regex>
#include <utility>

namespace fluidtex::scenes {

namespace {

constexpr std::array kQualities = {Quality::standard, Quality::preview, Quality::final};

std::string joinedLines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

// Takes the [quality] table out of the document and gives what is in it for each quality, in the order of
// kQualities.
std::array<Node, 3> takeQualities(Node& document, Faults& faults) {
  std::array<Node, 3> result;
  for (Node& node : result) node = {Table{}, document.origin};
  Table& root = std::get<Table>(document.value);
  const Entry* entry = find(root, "quality");
  if (!entry) return result;
  const Table* table = std::get_if<Table>(&entry->node.value);
  if (!table) {
    faults.add(entry->node.origin, "quality",
               "wrong type, " + kindName(entry->node) + " where a table is wanted",
               "head it with [quality.preview] or [quality.final]");
  } else {
    for (const auto& [name, node] : *table) {
      const std::string path = "quality." + name;
      if (name != "preview" && name != "final") {
        const std::string near = nearestName(name, {"preview", "final"});
        faults.add(node.origin, path, "unknown key",
                   near.empty() ? "known here: preview and final; what is outside of them is the default"
                                : "did you mean quality." + near + "?");
      } else if (!std::holds_alternative<Table>(node.value)) {
        faults.add(node.origin, path, "wrong type, " + kindName(node) + " where a table is wanted",
                   "head it with [" + path + "]");
      } else {
        result[name == "preview" ? 1 : 2] = expanded(node, path + ".", faults);
      }
    }
  }
  std::erase_if(root, [](const Entry& other) { return other.key == "quality"; });
  return result;
}

// What the command line adds, in the order in which it is laid over the scene.
std::vector<Node> readOverrides(const Overrides& overrides, Faults& faults) {
  std::vector<Node> layers;
  for (const std::string& assignment : overrides.set)
    layers.push_back(readAssignment(assignment, int(layers.size()) + 1, faults));
  if (!overrides.exemplar.empty()) {
    const std::string name = overrides.exemplar.string();
    const Origin origin{int(layers.size()) + 1, 1, 1, "--exemplar " + shortened(name, 160), ""};
    const auto layer = [&](const char* key, auto value) {
      return Node{Table{{"texture", Node{Table{{key, Node{value, origin}}}, origin}}}, origin};
    };
    layers.push_back(layer("exemplar", name));
    // Whether it wraps, the maps over it, their relief and glow, a finer picture and what chooses pictures of
    // a sequence were said of the scene's own; --set may say it of this one.
    layers.insert(layers.begin(),
                  {layer("toroidal", false), layer("map", List{}), layer("between", std::string("points")),
                   layer("between_file", std::string())});
    const auto givesMap = [](const std::string& assignment) {
      return assignment.starts_with("texture.guidance.map");
    };
    if (std::none_of(overrides.set.begin(), overrides.set.end(), givesMap)) {
      const Node unguided{Table{{"by", Node{std::string("none"), origin}}}, origin};
      layers.insert(layers.begin(), layer("guidance", unguided.value));
    }
    const Node byTime{Table{{"by", Node{std::string("time"), origin}}}, origin};
    layers.insert(layers.begin(), layer("animation", byTime.value));
    const Node flat{Table{{"height", Node{0.0, origin}}}, origin};
    const Node cold{Table{{"glow", Node{0.0, origin}}}, origin};
    const Node plain{Table{{"bump", Node{flat.value, origin}},
                           {"displacement", Node{flat.value, origin}},
                           {"material", Node{cold.value, origin}}},
                     origin};
    layers.insert(layers.begin(), Node{Table{{"render", Node{plain.value, origin}}}, origin});
  }
  return layers;
}

Scene readScene(const Node& document, const std::filesystem::path& file, bool liquidOnly, Faults& faults) {
  Scene scene;
  scene.file = file;
  Reader reader(document, file.parent_path(), faults);
  reader.absent("quality");
  describe(reader, scene, liquidOnly ? Need::optional : Need::required);
  reader.reportUnknownKeys();
  // The file's own was taken out before; what is left was put there by a quality or by the command line.
  if (reader.given("quality"))
    reader.fault("quality", "cannot be set from here", "set the key itself, for example domain.resolution");
  complete(scene, reader);
  check(scene, reader);
  return scene;
}

// The cache's folder, or what the names of its files have in common: "water" of water_####.vdb.
std::string nameOfCache(const std::filesystem::path& cache) {
  // "." and ".." too are folders with a name.
  const std::filesystem::path whole = std::filesystem::absolute(cache).lexically_normal();
  const std::filesystem::path plain = whole.has_filename() ? whole : whole.parent_path();
  if (std::filesystem::is_directory(plain)) return plain.filename().string();
  std::string name = plain.filename().string();
  name.resize(std::min(name.find('.'), name.size()));
  static const std::regex kNumber("[-_ ]*(#+|%[0-9]*d|[0-9]+)$");
  name = std::regex_replace(name, kNumber, "");
  return name.empty() ? "cache" : name;
}

// A scene whose liquid comes out of files, with the qualities that shipped scenes have too.
Node documentOfCache(const std::filesystem::path& cache) {
  const Origin origin{0, 1, 1, cache.string(), ""};
  const auto leaf = [&](auto value) { return Node{std::move(value), origin}; };
  const auto table = [&](const std::vector<std::pair<std::string, Node>>& entries) {
    Table result;
    for (const auto& [key, node] : entries) result.push_back({key, node});
    return Node{std::move(result), origin};
  };
  const auto quality = [&](std::int64_t points, std::int64_t width, std::int64_t height,
                           std::int64_t samples) {
    return table(
        {{"texture", table({{"points", leaf(points)}})},
         {"render", table({{"size", leaf(List{leaf(width), leaf(height)})}, {"samples", leaf(samples)}})}});
  };
  // Absolute, since the folder of this scene is none.
  return table(
      {{"name", leaf(nameOfCache(cache))},
       {"motion", table({{"flow", leaf(std::string("files"))}})},
       {"files", table({{"path", leaf(std::filesystem::absolute(cache).lexically_normal().string())}})},
       {"quality",
        table({{"preview", quality(10000, 480, 270, 8)}, {"final", quality(200000, 1920, 1080, 64)}})}});
}

// Says of the node and all below that they are written in a file which the scene extends.
void markExtended(Node& node, const std::string& file) {
  node.origin.extended = file;
  if (Table* table = std::get_if<Table>(&node.value)) {
    for (Entry& entry : *table) markExtended(entry.node, file);
  } else if (List* list = std::get_if<List>(&node.value)) {
    for (Node& member : *list) markExtended(member, file);
  }
}

// The document over that of the file which its key `extends` names, relative to `folder`.
Node extended(Node document, const std::filesystem::path& folder, int depth, Faults& faults) {
  constexpr int kDeepest = 8;
  Table& root = std::get<Table>(document.value);
  const Entry* entry = find(root, "extends");
  if (!entry) return document;
  const Origin origin = entry->node.origin;
  const std::string* name = std::get_if<std::string>(&entry->node.value);
  if (!name) {
    faults.add(origin, "extends", "wrong type, " + kindName(entry->node) + " where a string is wanted",
               "give a scene file, for example extends = \"river.toml\"");
    return document;
  }
  const std::filesystem::path file = (folder / *name).lexically_normal();
  std::error_code ignored;
  if (depth == kDeepest) {
    faults.add(origin, "extends", "goes on for more than " + std::to_string(kDeepest) + " files",
               "extend a scene that does not come back to this one");
  } else if (!std::filesystem::is_regular_file(file, ignored)) {
    faults.add(origin, "extends", "no such file: " + file.string(),
               "give a scene file, relative to the folder of the one that extends it");
  } else {
    std::erase_if(root, [](const Entry& other) { return other.key == "extends"; });
    Node base = expanded(readDocument(file, faults), "", faults);
    markExtended(base, file.string());
    base = extended(std::move(base), file.parent_path(), depth + 1, faults);
    overlay(base, document, faults);
    base.origin = document.origin;
    return base;
  }
  return document;
}

Node readSource(const Source& source, Faults& faults) {
  Node document = source.text ? readDocument(*source.text, source.file.string(), faults)
                              : readDocument(source.file, faults);
  if (!faults.empty()) return document;
  return extended(expanded(document, "", faults), source.file.parent_path(), 0, faults);
}

// The document with one of its qualities and the command line's layers over it.
Node overlaid(Node document, const Node& quality, const std::vector<Node>& commandLine, Faults& faults) {
  overlay(document, quality, faults);
  for (const Node& layer : commandLine) overlay(document, layer, faults);
  return document;
}

// A document with the command line's layers over it.
Scene resolved(const Node& written, const std::filesystem::path& file, const Overrides& overrides) {
  Faults faults;
  const std::vector<Node> commandLine = readOverrides(overrides, faults);
  Node document = expanded(written, "", faults);
  const std::array<Node, 3> qualities = takeQualities(document, faults);

  // All qualities are checked, whichever is asked for. A fault that the default has not, but is told at a key
  // outside of the quality's own table, says which quality it comes from.
  Scene scene;
  Faults ofDefault;
  for (std::size_t i = 0; i < kQualities.size(); ++i) {
    Faults found;
    const Node whole = overlaid(document, qualities[i], commandLine, found);
    Scene candidate = readScene(whole, file, overrides.liquidOnly, found);
    if (kQualities[i] == overrides.quality) scene = std::move(candidate);
    if (i == 0) ofDefault = found;
    for (Fault fault : found.all()) {
      if (i > 0 && fault.origin.prefix.empty() && !ofDefault.has(fault))
        fault.message += " (in quality " + std::string(nameOf(kQualities[i])) + ")";
      faults.add(fault);
    }
  }
  if (!faults.empty()) throw SceneError(faults.lines());
  scene.resolved = resolvedText(scene, overrides.quality);
  return scene;
}

}  // namespace

const char* nameOf(Quality quality) {
  return quality == Quality::preview ? "preview" : quality == Quality::final ? "final" : "default";
}

SceneError::SceneError(std::vector<std::string> lines)
    : std::runtime_error(joinedLines(lines)), faults(std::move(lines)) {}

Scene loadScene(const std::filesystem::path& file, const Overrides& overrides) {
  return loadScene(Source{file, {}}, overrides);
}

Scene loadScene(const Source& source, const Overrides& overrides) {
  Faults faults;
  const Node written = readSource(source, faults);
  // Without the file's content everything would be missing from it.
  if (!faults.empty()) {
    readOverrides(overrides, faults);
    throw SceneError(faults.lines());
  }
  return resolved(written, source.file, overrides);
}

std::string faultLine(const Source& source, const Overrides& overrides, const std::string& key,
                      const std::string& message) {
  Faults ignored, faults;
  const std::vector<Node> commandLine = readOverrides(overrides, ignored);
  Node document = expanded(readSource(source, ignored), "", ignored);
  const std::array<Node, 3> qualities = takeQualities(document, ignored);
  const auto quality =
      std::find(kQualities.begin(), kQualities.end(), overrides.quality) - kQualities.begin();
  const Node whole = overlaid(document, qualities[std::size_t(quality)], commandLine, ignored);
  faults.add({Reader(whole, source.file.parent_path(), ignored).originOf(key), key, message});
  return faults.lines().front();
}

Scene sceneOfCache(const std::filesystem::path& cache, const Overrides& overrides) {
  return resolved(documentOfCache(cache), cache, overrides);
}

}  // namespace fluidtex::scenes
