// The quick set of `fluidtex validate`: every bar in it holds.
#include "tools/validation/case.h"

#include <catch2/catch.hpp>

#include <string>

using namespace fluidtex::validation;

namespace {

void runQuick(const std::string& group) {
  bool any = false;
  for (const Case& c : cases()) {
    if (c.group != group) continue;
    for (const int resolution : c.quick) {
      for (const Row& row : c.run(resolution, {}).rows) {
        INFO(row.test << " at " << row.resolution << ": " << row.measure << " is " << row.value);
        CHECK(row.ok());
        any = any || row.must.has_value();
      }
    }
  }
  CHECK(any);
}

}  // namespace

TEST_CASE("validation: the quick level-set tests hold their bars") {
  runQuick("level_set");
}

TEST_CASE("validation: the quick fluid tests hold their bars") {
  runQuick("fluid");
}
