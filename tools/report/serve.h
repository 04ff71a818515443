// fluidtex view: the page of a run, served while the run goes on.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace fluidtex::tools {

// Serves the folder of a run, finished or not, on 127.0.0.1, to this machine alone, until the process ends:
//   /              the page
//   /run           its figures (tools/report/figures.h) as they are now, with "pictures" and "meshes"
//                  (frames), and "video" ({"name", "bytes"} or null)
//   /frames/N.png  the picture of frame N as the run wrote it
//   /mesh/N        its surface, by packMesh()
//   /video
// Nothing else is answered, and nothing under other names of this machine, by which pages from elsewhere
// could ask. Only reads. port: 0: any that is free. ready(port): called when it listens. Throws
// UsageError if the folder is not there, or the port is taken.
void serveRun(const std::filesystem::path& out, int port, const std::function<void(int)>& ready);

}  // namespace fluidtex::tools
