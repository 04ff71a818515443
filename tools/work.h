// What the program is at, for the sentence that it ends with where memory runs out.
#pragma once

#include <exception>

namespace fluidtex::tools {

// `what` it makes, and what to lower so that this takes less.
struct Work {
  const char* what;
  const char* lower;
};

inline constexpr Work kOnFiles{"the files that the scene names", "their size"};
inline constexpr Work kOnExemplar{"the tables of the exemplar", "the exemplar's size or texture.windows"};
inline constexpr Work kOnMotion{"the motion of the liquid", "domain.resolution"};
inline constexpr Work kOnSurface{"the points of the surface",
                                 "texture.points (or give a larger texture.spacing)"};
inline constexpr Work kOnTexture{"the texture", "texture.points (or give a larger texture.spacing)"};
inline constexpr Work kOnPicture{"the picture", "render.size or texture.points"};
inline constexpr Work kOnRun{"the surfaces of the run", "their number of points"};
inline constexpr Work kOnFrameFiles{"the frame's files", "texture.points or domain.resolution"};

// From now on; `frame` 0: none. The work must live for ever.
void nowAt(const Work& work, int frame = 0);

// "out of memory: ..." with what was last told to be made, and what may be lowered. Needs no memory of its
// own; the same text at each call.
const char* outOfMemory();

// What to do where this was thrown since no thread could be started, to be put behind its own words; else
// empty.
const char* threadAdvice(const std::exception& error);

// From now on the program ends with one sentence and kFailed where an exception is thrown that nobody can
// catch: a library cannot start a thread, or memory runs out in one of its threads. What has a final name
// stays whole.
void endWithSentence();

}  // namespace fluidtex::tools
