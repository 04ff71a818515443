#include "tools/base/errors.h"

#include "caches/formats/format_error.h"
#include "caches/layouts/numbered_files.h"
#include "scenes/faults.h"
#include "scenes/scene.h"
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/read_heights.h"
#include "texture/exemplar/exemplar.h"
#include "tools/base/console.h"
#include "tools/base/work.h"

#include <spdlog/spdlog.h>

#include <new>
#include <string>

namespace fluidtex::tools {
namespace {

// One line that can be read, whatever a library has put into its message: a damaged file's bytes, for one.
std::string readable(std::string text) {
  constexpr std::size_t kLongest = 2000;
  if (text.size() > kLongest) text = text.substr(0, kLongest) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

int fault(const std::string& message, ExitCode code) {
  const std::string sentence = readable(message);
  say("error: {}\n", sentence);
  spdlog::error("{}", sentence);
  return code;
}

}  // namespace

int guarded(const std::function<void()>& body) {
  try {
    body();
    finishPrinting();
    return kDone;
  } catch (const scenes::SceneError& error) {
    for (const std::string& line : error.faults) {
      say("{}\n", line);
      spdlog::error("{}", line);
    }
    return kInputWrong;
  } catch (const texture::ExemplarError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const sim::MeshError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const sim::HeightError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const caches::LayoutError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const caches::FormatError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const UsageError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const Interrupted& error) {
    say("{}\n", error.what());
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    return fault(outOfMemory(), kFailed);
  } catch (const std::length_error&) {  // more than any memory holds
    return fault(outOfMemory(), kFailed);
  } catch (const std::exception& error) {
    return fault(std::string(error.what()) + threadAdvice(error), kFailed);
  }
}

}  // namespace fluidtex::tools
