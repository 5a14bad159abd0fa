// SPDX-License-Identifier: MIT
#include <support/eigen_oracle.hpp>

#include <Eigen/Dense>

namespace fovea::test {
namespace {

Eigen::MatrixXd matrix_of(const PlainMatrix& a) {
    return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
        a.values.data(), a.rows, a.columns);
}
template <class Values>
std::vector<double> list_of(const Values& values) {
    return {values.data(), values.data() + values.size()};
}

}  // namespace

std::vector<double> eigen_singular_values(const PlainMatrix& a) {
    return list_of(Eigen::JacobiSVD<Eigen::MatrixXd>(matrix_of(a)).singularValues());
}

std::vector<double> eigen_eigenvalues(const PlainMatrix& a) {
    const std::vector<double> up = list_of(
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix_of(a), Eigen::EigenvaluesOnly).eigenvalues());
    return {up.rbegin(), up.rend()};
}

std::vector<double> eigen_least_squares(const PlainMatrix& a, const std::vector<double>& b) {
    const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(b.data(), a.rows);
    return list_of(Eigen::VectorXd(matrix_of(a).colPivHouseholderQr().solve(right)));
}

}  // namespace fovea::test
