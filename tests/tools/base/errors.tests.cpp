#include "tools/base/errors.h"

#include "sim/meshes/read_mesh.h"
#include "sim/step/solver.h"
#include "texture/exemplar/exemplar.h"

#include <catch2/catch.hpp>

#include <new>

using namespace fluidtex;

TEST_CASE("errors: wrong input is 1, what fails on the way 2, an interrupt 130", "[tools]") {
  CHECK(tools::guarded([] {}) == tools::kDone);
  CHECK(tools::guarded([] { throw tools::UsageError("test: a wish"); }) == tools::kInputWrong);
  CHECK(tools::guarded([] { throw sim::MeshError("test: a mesh"); }) == tools::kInputWrong);
  CHECK(tools::guarded([] { throw texture::ExemplarError("test: an exemplar"); }) == tools::kInputWrong);
  CHECK(tools::guarded([] { throw sim::SolverError("test: a step"); }) == tools::kFailed);
  CHECK(tools::guarded([] { throw std::bad_alloc(); }) == tools::kFailed);
  CHECK(tools::guarded([] { throw tools::Interrupted(); }) == tools::kInterrupted);
}
