#include "tools/report/preview.h"

#include "render/other_program.h"

#include <fmt/core.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace fluidtex::tools {

std::string previewOf(const std::filesystem::path& picture, int width) {
  std::ifstream in(picture, std::ios::binary);
  // By its content: a name may hold what ffmpeg takes for a pattern.
  const std::string png{std::istreambuf_iterator<char>(in), {}};
  const std::string smaller = fmt::format("scale=w='min({},iw)':h=-1:flags=area", width);
  const render::Outcome made =
      render::runOther({"ffmpeg", "-v", "error", "-nostdin", "-threads", "1", "-f", "png_pipe", "-i", "-",
                        "-vf", smaller, "-q:v", "4", "-f", "mjpeg", "-"},
                       png);
  if (made.exitCode != 0 || made.output.empty())
    throw std::runtime_error(picture.string() +
                             ": ffmpeg cannot read the picture: " + render::lastLine(made.complaints));
  return made.output;
}

}  // namespace fluidtex::tools
