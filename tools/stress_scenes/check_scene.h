// Runs a scene's liquid and checks, frame by frame, what holds in any scene.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::stress {

struct Failure {
  std::string invariant;
  int frame = 0;     // the first in which it does not hold; 0 where it is of none
  std::string what;  // by how much, and where
};

// Every invariant that does not hold, the first time that it does not. They are:
//   loader   the scene file is read without a fault
//   runs     the solver comes to the end, in no more steps than a flow so fast can take
//   finite   no value of the state is infinite or no number
//   poured   on the first frame there is as much liquid as the shapes hold
//   volume   liquid and what is owed are together what was poured, what came and what went, to 1% of it
//   owed     what is owed is less than 2% of the liquid, but for a few frames, and half of thin sheets; more
//            may be owed while what is seen is films
//   outside  no liquid where there is no open way to
//   energy   of motion, place and surface together, with what liquid that is owed may have, does not rise
//            where nothing drives the liquid
//   speed    is no more than what gravity, height and what drives the liquid can give, three times
//            that where solids move
//   rest     what is at rest stays at rest
//   threads  the state after the last frame has the same bytes on one thread as on two
//   restart  and the same bytes where it was written and read again half way
// scratch: a folder in which a state can be written. wanted: where given, no more is done than it takes to
// know whether this one fails.
std::vector<Failure> checkScene(const std::filesystem::path& file, const std::filesystem::path& scratch,
                                const std::string& wanted = "");

}  // namespace fluidtex::stress
