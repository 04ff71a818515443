#include "tools/validation/case.h"

#include "tools/validation/aligned_cases.h"
#include "tools/validation/dam_break_cases.h"
#include "tools/validation/film_cases.h"
#include "tools/validation/level_set_cases.h"
#include "tools/validation/marin_case.h"
#include "tools/validation/pressure_cases.h"
#include "tools/validation/reinit_cases.h"
#include "tools/validation/rest_cases.h"
#include "tools/validation/shallow_cases.h"
#include "tools/validation/sheet_cases.h"
#include "tools/validation/spread_cases.h"
#include "tools/validation/stream_cases.h"
#include "tools/validation/tension_cases.h"
#include "tools/validation/viscous_cases.h"
#include "tools/validation/wave_cases.h"

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
                       filmCases, sheetCases, spreadCases, tensionCases}) {
      for (Case& c : part()) list.push_back(std::move(c));
    }
    return list;
  }();
  return all;
}

}  // namespace fluidtex::validation
