// What tells builds of this room apart that may compute other things.
#pragma once

#include <string_view>

namespace fluidtex::texture {

// The hash of all sources of this room and of what compiles them, taken when it is built
// (cmake/build_id.cmake). What is kept from run to run is known by it too: a list of those sources that a
// table depends on, or a number to be raised by hand, would be forgotten one day, and a wrong table is found
// by nobody. The price is that tables are built once more after any change here.
std::string_view buildId();

}  // namespace fluidtex::texture
