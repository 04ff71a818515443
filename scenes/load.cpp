#include "scenes/checks.h"
#include "scenes/complete.h"
#include "scenes/document.h"
#include "scenes/faults.h"
#include "scenes/reader.h"
#include "scenes/scene.h"
#include "scenes/schema.h"
#include "scenes/writer.h"

#include <array>
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
    // Whether it wraps, the maps over it, their relief and a finer picture were said of the scene's own
    // picture; --set may say it of this one.
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
    const Node flat{Table{{"height", Node{0.0, origin}}}, origin};
    const Node unbumped{Table{{"bump", Node{flat.value, origin}}}, origin};
    layers.insert(layers.begin(), Node{Table{{"render", Node{unbumped.value, origin}}}, origin});
  }
  return layers;
}

Scene readScene(const Node& document, const std::filesystem::path& file, Faults& faults) {
  Scene scene;
  scene.file = file;
  Reader reader(document, file.parent_path(), faults);
  reader.absent("quality");
  describe(reader, scene);
  reader.reportUnknownKeys();
  // The file's own was taken out before; what is left was put there by a quality or by the command line.
  if (reader.given("quality"))
    reader.fault("quality", "cannot be set from here", "set the key itself, for example domain.resolution");
  complete(scene, reader);
  check(scene, reader);
  return scene;
}

}  // namespace

const char* nameOf(Quality quality) {
  return quality == Quality::preview ? "preview" : quality == Quality::final ? "final" : "default";
}

SceneError::SceneError(std::vector<std::string> lines)
    : std::runtime_error(joinedLines(lines)), faults(std::move(lines)) {}

Scene loadScene(const std::filesystem::path& file, const Overrides& overrides) {
  Faults faults;
  const Node written = readDocument(file, faults);
  const bool readable = faults.empty();
  const std::vector<Node> commandLine = readOverrides(overrides, faults);
  // Without the file's content everything would be missing from it.
  if (!readable) throw SceneError(faults.lines());

  Node document = expanded(written, "", faults);
  const std::array<Node, 3> qualities = takeQualities(document, faults);

  // All qualities are checked, whichever is asked for. A fault that the default has not, but is told at a key
  // outside of the quality's own table, says which quality it comes from.
  Scene scene;
  Faults ofDefault;
  for (std::size_t i = 0; i < kQualities.size(); ++i) {
    Faults found;
    Node resolved = document;
    overlay(resolved, qualities[i], found);
    for (const Node& layer : commandLine) overlay(resolved, layer, found);
    Scene candidate = readScene(resolved, file, found);
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

}  // namespace fluidtex::scenes
