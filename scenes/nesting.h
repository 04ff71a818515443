// How deep a text of TOML nests, before it is parsed: the parser's own tables end one in another, each on the
// stack of the one around it, and it only limits brackets, not the parts of dotted keys.
#pragma once

#include <optional>
#include <string_view>

namespace fluidtex::scenes {

inline constexpr int kDeepest = 64;  // brackets and parts of keys, one in another

struct TextPlace {
  int line = 1, column = 1;
};

// The first place that lies deeper, if any.
std::optional<TextPlace> tooDeep(std::string_view text);

}  // namespace fluidtex::scenes
