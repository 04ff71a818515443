// Dense linear algebra that several rooms need, compiled once: Eigen's decompositions take ten seconds a
// file.
#pragma once

#include <Eigen/Core>

namespace fluidtex::texture {

// Eigenvectors of a symmetric positive semi-definite matrix, in the order of falling eigenvalues.
struct PrincipalAxes {
  Eigen::VectorXd variance;  // n, falling, not below 0
  Eigen::MatrixXd axis;      // n x n, a unit vector a column; signs are arbitrary
};

// covariance: n x n, symmetric; its lower triangle is read.
PrincipalAxes principalAxes(const Eigen::MatrixXd& covariance);

// An orthonormal basis of the span of the columns, of which there are no more than rows (QR by Householder
// reflections).
Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns);

}  // namespace fluidtex::texture
