#include "tools/errors.h"

#include "scenes/faults.h"
#include "scenes/scene.h"
#include "sim/read_heights.h"
#include "sim/read_mesh.h"
#include "texture/exemplar.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <new>
#include <string>

namespace fluidtex::tools {
namespace {

int fault(const std::string& whole, ExitCode code) {
  // What a damaged file calls itself may be megabytes long.
  const std::string sentence = scenes::shortened(whole, 4000);
  fmt::print(stderr, "error: {}\n", sentence);
  spdlog::error("{}", sentence);
  return code;
}

}  // namespace

int guarded(const std::function<void()>& body) {
  try {
    body();
    return kDone;
  } catch (const scenes::SceneError& error) {
    for (const std::string& line : error.faults) fmt::print(stderr, "{}\n", line);
    return kInputWrong;
  } catch (const texture::ExemplarError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const sim::MeshError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const sim::HeightError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const UsageError& error) {
    return fault(error.what(), kInputWrong);
  } catch (const Interrupted& error) {
    fmt::print(stderr, "{}\n", error.what());
    return kInterrupted;
  } catch (const std::bad_alloc&) {
    return fault("there is not enough memory; a lower domain.resolution or fewer texture.points take less",
                 kFailed);
  } catch (const std::exception& error) {
    return fault(error.what(), kFailed);
  }
}

}  // namespace fluidtex::tools
