// Identifies the build of this room, for caches.
#pragma once

#include <string_view>

namespace fluidtex::texture {

// Hash of all sources of this room and of what compiles them, taken at build time (cmake/build_id.cmake). It
// is part of the key of cached tables. A list of the sources that a table depends on, or a version number,
// would be forgotten one day, and nobody would notice a wrong table. The price: tables are rebuilt once after
// any change here.
std::string_view buildId();

}  // namespace fluidtex::texture
