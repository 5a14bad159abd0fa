// SPDX-License-Identifier: MIT
//
// What Eigen says of a matrix, compiled once.
#pragma once

#include <vector>

namespace fovea::test {

/// A matrix of double, row by row.
struct PlainMatrix {
    int rows = 0;
    int columns = 0;
    std::vector<double> values;
};

/// The largest first.
std::vector<double> eigen_singular_values(const PlainMatrix& a);
/// Of a symmetric matrix, the largest first.
std::vector<double> eigen_eigenvalues(const PlainMatrix& a);
/// The solution of least squares, or of as many equations as unknowns.
std::vector<double> eigen_least_squares(const PlainMatrix& a, const std::vector<double>& b);

}  // namespace fovea::test
