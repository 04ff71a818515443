// The page of the validation's figures, docs/results/validation.md, brought up to date by what was measured.
#pragma once

#include "tests/validation/case.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Thrown where a page has no table for what was measured; the message says which test.
struct PageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The page with these rows in its tables. A table of figures has the columns test, cells, measure, value,
// must, goal, published and a last one without a name: goal, holds, **fails**, or nothing for a row without a
// bar. Rows that were not measured stay; new ones of a test come after its others. Then the rows that fail
// are listed anew below the line "Of the solver:", and those of each topic (a heading of three #) are counted
// in the table whose rows begin with a link to it. Throws PageError where a test has no row in any table.
std::string updatedPage(const std::string& page, const std::vector<validation::Row>& rows);

}  // namespace fluidtex::tools
