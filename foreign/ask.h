// Libraries that read files of others may crash on a damaged one, never come to an end, or take all memory.
// They run in fluidtex_reader, a program of its own, which is started with the first question and reads each
// file in a process that is limited in time and memory and that writes nothing.
#pragma once

#include "foreign/unreadable.h"

#include <filesystem>
#include <functional>
#include <istream>
#include <string>
#include <string_view>

namespace fluidtex::foreign {

enum class Wanted : char {
  colors = 'c',         // a picture, as light
  numbers = 'n',        // a picture, as what is stored
  heights = 'h',        // only the first channel of that, and what stands for none
  color_note = 'k',     // of a picture only what there is to say of its colours
  floats = 'f',         // the first grid of floats of an OpenVDB file
  vectors = 'v',        // the first one of float vectors
  grids = 'g',          // what there is to say of all grids, packed()
  named_floats = 'F',   // the first grid of a name, as floats
  named_vectors = 'V',  // as float vectors
};

// Has the file read, and gives the answer to `take` in pieces, in order. `part` is the name of what is wanted
// in the file. Throws Unreadable: what the reader finds wrong, and where it crashes, takes longer than the
// file's size warrants (6 s and one more a megabyte and 5 million pixels) or more than 1.5 GB (grids: than
// 8 MB and 256 times the file, or, where that is more than 1.5 GB, 32 times the file). From several threads
// the files are read one after another.
void ask(Wanted wanted, const std::filesystem::path& file, const std::function<void(std::string_view)>& take,
         const std::string& part = {});

// The same as a stream that can be read while the answer comes. Where it ends too early it throws
// std::ios_base::failure; what `parse` throws is passed on, unless the reader has found something wrong.
// `parse` must not ask itself.
void askForStream(Wanted wanted, const std::filesystem::path& file,
                  const std::function<void(std::istream&)>& parse, const std::string& part = {});

}  // namespace fluidtex::foreign
