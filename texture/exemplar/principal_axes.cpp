#include "texture/exemplar/principal_axes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

namespace fluidtex::texture {

PrincipalAxes principalAxes(const Eigen::MatrixXd& covariance) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(covariance);
  return {solver.eigenvalues().cwiseMax(0.0).reverse(), solver.eigenvectors().rowwise().reverse()};
}

Eigen::MatrixXf orthonormal(const Eigen::MatrixXf& columns) {
  const Eigen::HouseholderQR<Eigen::MatrixXf> qr(columns);
  return qr.householderQ() * Eigen::MatrixXf::Identity(columns.rows(), columns.cols());
}

}  // namespace fluidtex::texture
