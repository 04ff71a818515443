// Updates docs/results/validation.md, and figures.md beside it, with measured results.
#pragma once

#include "tools/validation/case.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::tools {

// A page without a table for a test; the message names the test.
struct PageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The page with these rows in its tables. A table of figures has the columns test, cells, measure, value,
// must, goal, published, and an unnamed last one: goal, holds, **fails**, or empty for a row that has no bar
// and does not reach a goal. Rows not measured stay; new rows of a test follow its others. Rows that fail are
// listed below the line "Of the solver:", and the rows of each topic (a heading of three #) are counted in
// the table whose rows begin with a link to it. Throws PageError if a test has no row in any table.
std::string updatedPage(const std::string& page, const std::vector<validation::Row>& rows);

}  // namespace fluidtex::tools
