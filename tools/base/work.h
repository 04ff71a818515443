// The current work of the program, for the message when memory runs out.
#pragma once

#include <exception>

namespace fluidtex::tools {

// `what` it makes, and which setting lowers its memory.
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

// Sets the current work; `frame` 0: none. The work must have static lifetime.
void nowAt(const Work& work, int frame = 0);

// "out of memory: ..." with the current work and the setting that lowers it. Allocates nothing; returns the
// same text at each call.
const char* outOfMemory();

// Advice to append to the message if the exception means that no thread could be started; else empty.
const char* threadAdvice(const std::exception& error);

// Makes the program end with one sentence and kFailed on an exception that nobody can catch: a library cannot
// start a thread, or memory runs out in one of its threads. Files with a final name stay intact.
void endWithSentence();

}  // namespace fluidtex::tools
