#include "tests/validation/case.h"

#include "tests/validation/aligned_cases.h"
#include "tests/validation/dam_break_cases.h"
#include "tests/validation/film_cases.h"
#include "tests/validation/level_set_cases.h"
#include "tests/validation/marin_case.h"
#include "tests/validation/pressure_cases.h"
#include "tests/validation/reinit_cases.h"
#include "tests/validation/rest_cases.h"
#include "tests/validation/shallow_cases.h"
#include "tests/validation/spread_cases.h"
#include "tests/validation/stream_cases.h"
#include "tests/validation/tension_cases.h"
#include "tests/validation/viscous_cases.h"
#include "tests/validation/wave_cases.h"

#include <cmath>

namespace fluidtex::validation {

bool Row::ok() const {
  if (!must) return true;
  return atLeast ? value >= *must : std::abs(value) <= *must;
}

Row row(const std::string& test, int resolution, const std::string& measure, double value,
        std::optional<double> must, std::optional<double> goal) {
  return {test, resolution, measure, value, must, goal, false, {}, 0.0};
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = [] {
    std::vector<Case> list;
    for (auto* part : {levelSetCases, reinitCases, pressureCases, waveCases, restCases, alignedCases,
                       damBreakCases, marinCases, streamCases, shallowCases, shearCases, viscousFlowCases,
                       filmCases, spreadCases, tensionCases}) {
      for (Case& c : part()) list.push_back(std::move(c));
    }
    return list;
  }();
  return all;
}

}  // namespace fluidtex::validation
