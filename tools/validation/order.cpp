#include "tools/validation/order.h"

#include <cmath>

namespace fluidtex::validation {

std::vector<Row> orderRows(const std::vector<Row>& rows, const std::string& measure,
                           std::optional<double> must, std::optional<double> goal) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  int finest = 0;
  std::string test;
  for (const Row& row : rows) {
    if (row.measure != measure || row.value == 0.0) continue;
    const double x = std::log(double(row.resolution)), y = std::log(std::abs(row.value));
    n += 1.0, sx += x, sy += y, sxx += x * x, sxy += x * y;
    finest = std::max(finest, row.resolution);
    test = row.test;
  }
  if (n < 2.0) return {};
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {
      {test, finest, "order of " + measure.substr(0, measure.find(',')), -slope, must, goal, true, {}, 0.0}};
}

}  // namespace fluidtex::validation
