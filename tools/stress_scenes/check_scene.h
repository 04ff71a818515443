// Runs a scene's liquid and checks, frame by frame, invariants of every scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::stress {

struct Failure {
  std::string invariant;
  int frame = 0;     // first one in which it fails; 0: not a frame's
  std::string what;  // by how much, and where
};

// Each invariant that fails, at its first failure:
//   loader   the scene file is read without a fault
//   runs     the solver reaches the end, in no more steps than a flow of that speed can take
//   finite   all values of the state are finite
//   poured   on the first frame there is as much liquid as the shapes hold
//   volume   liquid plus volume deficit is what was poured plus inflow minus outflow, to 1%
//   deficit  the volume deficit is less than 2% of the liquid, but for a few frames, and half of thin sheets;
//            more may be missing while what is seen is films
//   outside  no liquid where there is no open path to
//   energy   kinetic, potential and surface energy together, with what the volume deficit may have, do not
//            rise where nothing drives the liquid, except by the surface that drains lay open
//   speed    is no more than gravity, height and the driving forces can give, three times that where solids
//            move
//   rest     what is at rest stays at rest
//   threads  the state after the last frame has the same bytes on one thread as on two
//   restart  and the same bytes if it was written and read half way
// scratch: a folder in which a state can be written. wanted: if given, stops once it is known whether this
// invariant fails.
std::vector<Failure> checkScene(const std::filesystem::path& file, const std::filesystem::path& scratch,
                                const std::string& wanted = "");

}  // namespace fluidtex::stress
