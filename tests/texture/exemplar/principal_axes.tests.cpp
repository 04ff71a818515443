#include "texture/exemplar/principal_axes.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::texture;

TEST_CASE("principal axes: variances fall, axes are orthonormal and make the matrix again", "[texture]") {
  Eigen::MatrixXd factor(6, 6);
  for (Eigen::Index i = 0; i < factor.size(); ++i) factor.data()[i] = randomUnit(3, std::uint64_t(i)) - 0.5;
  const Eigen::MatrixXd covariance = factor * factor.transpose();
  const PrincipalAxes axes = principalAxes(covariance);
  for (Eigen::Index i = 1; i < 6; ++i) CHECK(axes.variance[i] <= axes.variance[i - 1]);
  CHECK((axes.axis.transpose() * axes.axis - Eigen::MatrixXd::Identity(6, 6)).norm() < 1e-12);
  CHECK((axes.axis * axes.variance.asDiagonal() * axes.axis.transpose() - covariance).norm() < 1e-12);
}

TEST_CASE("principal axes: a singular matrix has variances of 0, none below", "[texture]") {
  Eigen::MatrixXd flat = Eigen::MatrixXd::Zero(3, 3);
  flat(0, 0) = 4.0;
  const PrincipalAxes axes = principalAxes(flat);
  CHECK(axes.variance[0] == Approx(4.0));
  CHECK(std::abs(axes.axis(0, 0)) == Approx(1.0));
  CHECK(axes.variance[1] >= 0.0);
  CHECK(axes.variance[2] == Approx(0.0).margin(1e-12));
}

TEST_CASE("principal axes: an orthonormal basis spans the columns", "[texture]") {
  Eigen::MatrixXf columns(5, 2);
  columns << 1, 1, 1, -1, 0, 2, 0, 0, 3, 1;
  const Eigen::MatrixXf basis = orthonormal(columns);
  CHECK((basis.transpose() * basis - Eigen::MatrixXf::Identity(2, 2)).norm() < 1e-6f);
  CHECK((basis * (basis.transpose() * columns) - columns).norm() < 1e-5f);
}
