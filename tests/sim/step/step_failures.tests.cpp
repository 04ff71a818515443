#include "sim/step/step_failures.h"

#include "sim/step/solver.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;

namespace {

// The sentence with which a call fails.
template <class Call>
std::string sentenceOf(const Call& call) {
  try {
    call();
  } catch (const SolverError& error) {
    return error.what();
  }
  return "no fault";
}

}  // namespace

TEST_CASE("step failures: the time, the cause and what may help", "[sim]") {
  CHECK_THAT(sentenceOf([] { failCapillary(1.25); }),
             Contains("at time 1.25 s") && Contains("surface tension"));
  CHECK_THAT(sentenceOf([] { failFast(0.5, 300.0, 2.0); }), Contains("the velocity is 300 m/s"));
  CHECK_THAT(sentenceOf([] { failFast(0.5, 3.0, 2000.0); }),
             Contains("a solid moves at 2000 m/s") && Contains("keyframes"));
}

TEST_CASE("step failures: the solve that did not converge is named, the first one of the step", "[sim]") {
  StepReport report;
  report.viscosity.converged = false;
  report.viscosity.residual = 0.125;
  report.viscosity.iterations = 1000;
  report.pressure.converged = false;
  CHECK_THAT(sentenceOf([&] { fail(2.0, 0.001, report); }), Contains("viscosity solve") &&
                                                                Contains("0.125 after 1000 iterations") &&
                                                                Contains("even with a step of 0.001 s"));
  report.viscosity.converged = true;
  CHECK_THAT(sentenceOf([&] { fail(2.0, 0.0, report); }),
             Contains("pressure solve") && !Contains("even with"));
  report.heatConverged = false;
  CHECK_THAT(sentenceOf([&] { fail(2.0, 0.001, report); }), Contains("temperature"));
  StepReport solved;
  solved.pressure.converged = true;
  CHECK_THAT(sentenceOf([&] { fail(2.0, 0.001, solved); }), Contains("a velocity is not finite"));
}
