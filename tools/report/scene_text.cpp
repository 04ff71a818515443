#include "tools/report/scene_text.h"

namespace fluidtex::tools {
namespace {

bool isTables(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

std::string textOf(const Json& value);

// A list of values, without the nulls.
std::string listText(const Json& list) {
  std::string text;
  for (const Json& value : list)
    if (!value.is_null()) text += (text.empty() ? "" : ", ") + textOf(value);
  return "[" + text + "]";
}

// JSON's numbers, words and escapes are TOML's too.
std::string textOf(const Json& value) {
  return value.is_array() ? listText(value) : value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// The table's own keys come first: below the head of another table they would be that one's.
void addTable(std::string& text, const Json& table, const std::string& path) {
  for (const auto& [key, value] : table.items())
    if (!value.is_null() && !value.is_object() && !isTables(value))
      text += key + " = " + textOf(value) + "\n";
  for (const auto& [key, value] : table.items()) {
    const std::string name = path.empty() ? key : path + "." + key;
    if (value.is_object()) {
      text += "\n[" + name + "]\n";
      addTable(text, value, name);
    }
    if (!isTables(value)) continue;
    for (const Json& member : value) {
      text += "\n[[" + name + "]]\n";
      addTable(text, member, name);
    }
  }
}

}  // namespace

std::string sceneText(const Json& scene) {
  Json keys = scene;
  std::string text;
  if (const auto quality = keys.find("quality"); quality != keys.end()) {
    if (quality->is_string()) text = "# quality: " + quality->get<std::string>() + "\n";
    keys.erase("quality");
  }
  addTable(text, keys, "");
  return text;
}

}  // namespace fluidtex::tools
