// Whether all values of a grid can be used: in a process that may come to harm.
#pragma once

#include "foreign/unreadable.h"

#include <openvdb/openvdb.h>

namespace fluidtex::foreign::here {

// Throws Unreadable where active values are not finite: how many, and the first place in the order of x, y,
// z. `label` begins the sentence.
template <class Grid>
void refuseNonFinite(const Grid& grid, const std::string& label);

extern template void refuseNonFinite(const openvdb::FloatGrid&, const std::string&);
extern template void refuseNonFinite(const openvdb::Vec3SGrid&, const std::string&);

}  // namespace fluidtex::foreign::here
