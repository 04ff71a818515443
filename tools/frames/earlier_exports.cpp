#include "tools/frames/earlier_exports.h"

#include "tools/base/atomic_file.h"
#include "tools/base/errors.h"
#include "tools/base/fingerprint.h"
#include "tools/run_folder/journal.h"

#include <algorithm>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Formats whose file of this frame is whole, but would have other bytes now.
std::vector<Format> otherwiseNow(const fs::path& out, int frame, const Exports& exports,
                                 const texture::Image& color, const Journal& journal) {
  Exports whole = exports;
  std::erase_if(whole.formats, [&](Format format) {
    return format == Format::ply || !isWhole(journal, out, frameFile(format, frame));
  });
  if (whole.formats.empty()) return {};
  withTemporaryFolder(out, "exports", [&](const fs::path& tried) {
    writeFrameExports(out, frame, whole, color, tried);
    std::erase_if(whole.formats, [&](Format format) {
      const std::string name = frameFile(format, frame);
      return fingerprintOf(out / name) == fingerprintOf(tried / name);
    });
  });
  return whole.formats;
}

}  // namespace

void exportEarlierFrames(const fs::path& out, int first, int last, const Exports& exports,
                         const texture::Image& color, const std::atomic<bool>& stop) {
  if (exports.formats.size() == 1 || last < first) return;  // PLY alone
  const Journal journal = readJournal(out);
  const std::vector<Format> anew = otherwiseNow(out, last, exports, color, journal);
  for (int frame = first; frame <= last; ++frame) {
    Exports missing = exports;
    std::erase_if(missing.formats, [&](Format format) {
      return std::count(anew.begin(), anew.end(), format) == 0 &&
             isWhole(journal, out, frameFile(format, frame));
    });
    if (!missing.formats.empty()) exportFrame(out, frame, missing, color);
    if (stop) throw Interrupted();
  }
}

}  // namespace fluidtex::tools
