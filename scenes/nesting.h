// Nesting depth of a TOML text, checked before parsing: the parser destroys nested tables recursively, on the
// stack, and itself limits brackets only, not the parts of dotted keys.
#pragma once

#include <optional>
#include <string_view>

namespace fluidtex::scenes {

inline constexpr int kDeepest = 64;  // nested brackets and parts of keys

struct TextPlace {
  int line = 1, column = 1;
};

// The first place that is nested deeper, if any.
std::optional<TextPlace> tooDeep(std::string_view text);

}  // namespace fluidtex::scenes
