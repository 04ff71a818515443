#include "tools/frames/memory_plan.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using tools::Format;
using tools::JointsAs;

TEST_CASE("memory plan: formats take more the more kinds of joints they need", "[tools]") {
  const scenes::Scene scene;
  const auto plan = [&](double points, const std::vector<Format>& formats, JointsAs joints) {
    return tools::plannedMemory(scene, {}, points, formats, joints);
  };
  const auto per = [&](const std::vector<Format>& formats, JointsAs joints) {
    return plan(1e5, formats, joints) - plan(0.0, formats, joints);
  };
  const double ply = per({Format::ply}, JointsAs::blend),
               cut = per({Format::ply, Format::glb}, JointsAs::cut),
               blended = per({Format::ply, Format::glb}, JointsAs::blend),
               both = per({Format::ply, Format::glb, Format::vtp}, JointsAs::blend);
  CHECK(ply > 0.0);
  CHECK(cut > ply);
  CHECK(blended > cut);
  CHECK(both > blended);
  // These have their joints cut always, and one mesh does for all of them.
  CHECK(per({Format::ply, Format::obj, Format::vtp}, JointsAs::blend) == cut);
}
