// How fast an error falls with the size of the cells.
#pragma once

#include "tools/validation/case.h"

namespace fluidtex::validation {

// One row with the order of convergence of `measure`: the slope of log(error) over log(cells), least squares
// over all resolutions among `rows`. None for fewer than two.
std::vector<Row> orderRows(const std::vector<Row>& rows, const std::string& measure,
                           std::optional<double> must, std::optional<double> goal);

}  // namespace fluidtex::validation
