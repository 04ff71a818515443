// The file formats that the textured surface is written in, and where their files lie in the folder of a run.
//
// A further format needs a member of Format and a line of kFormatFiles here, a writer of an ExportMesh (as
// vtp.h) that write() in exports.cpp calls, a line in docs/reference/formats.md, and a share in
// tools/frames/disk_plan.cpp.
#pragma once

#include <string>
#include <vector>

namespace fluidtex::tools {

enum class Format { ply, glb, obj, usda, vtp };

struct FormatFiles {
  const char* name;       // on the command line
  const char* folder;     // in the folder of the run
  const char* extension;  // of a frame's file
  const char* sequence;  // extension of the file beside the folder that lists the frames; null: there is none
};

// In the order of Format.
inline constexpr FormatFiles kFormatFiles[] = {{"ply", "surface", ".ply", nullptr},
                                               {"glb", "glb", ".glb", nullptr},
                                               {"obj", "obj", ".obj", nullptr},
                                               {"usda", "usd", ".usda", ".usda"},
                                               {"vtp", "vtp", ".vtp", ".pvd"}};

inline const FormatFiles& filesOf(Format format) {
  return kFormatFiles[static_cast<int>(format)];
}

// A frame's file, relative to the folder of the run: "glb/0007.glb".
std::string frameFile(Format format, int frame);

// Formats by their names, each once, in the order of Format. PLY is always among them: it is the file that
// `render --from`, `apply`, `measure` and `--resume` read. Throws UsageError for a name that is none.
std::vector<Format> parseFormats(const std::vector<std::string>& names);

}  // namespace fluidtex::tools
