// SPDX-License-Identifier: MIT
//
// Matrices and vectors of fixed size, and views on them for algorithms of any size. Book appendix B.
#pragma once

#include <cstddef>
#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/scalar.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Somebody's matrix, row by row; rows begin stride elements apart.
template <class Scalar>
class MatrixView {
public:
    constexpr MatrixView() = default;
    constexpr MatrixView(Scalar* values, int rows, int columns, int stride)
        : values_(values), rows_(rows), columns_(columns), stride_(stride) {
        FOVEA_ASSERT(rows >= 0 && columns >= 0 && stride >= columns);
    }
    constexpr MatrixView(Scalar* values, int rows, int columns)
        : MatrixView(values, rows, columns, columns) {}
    /// A view that only reads.
    template <class Other, class = std::enable_if_t<std::is_same_v<Scalar, const Other>>>
    constexpr MatrixView(MatrixView<Other> other)
        : values_(other.values_), rows_(other.rows_), columns_(other.columns_), stride_(other.stride_) {}

    constexpr int rows() const { return rows_; }
    constexpr int columns() const { return columns_; }
    constexpr Scalar& operator()(int row, int column) const {
        FOVEA_ASSERT(row >= 0 && row < rows_ && column >= 0 && column < columns_);
        return values_[row * stride_ + column];
    }

private:
    template <class Other>
    friend class MatrixView;

    Scalar* values_ = nullptr;
    int rows_ = 0;
    int columns_ = 0;
    int stride_ = 0;
};

/// A matrix with storage of its own, row by row; all 0 at first.
template <int Rows, int Columns, class Scalar = Real>
class Matrix {
public:
    static_assert(Rows > 0 && Columns > 0, "a matrix has at least one element");
    using View = MatrixView<Scalar>;

    constexpr Matrix() = default;
    /// All elements, row by row.
    template <class... Elements, class = std::enable_if_t<(sizeof...(Elements) == Rows * Columns) &&
                                                          (std::is_same_v<Elements, Scalar> && ...)>>
    constexpr explicit Matrix(Elements... elements) : values_{elements...} {}
    static constexpr Matrix identity() {
        static_assert(Rows == Columns, "an identity is square");
        Matrix result;
        for (int i = 0; i < Rows; ++i) result(i, i) = scalar_of<Scalar>(1);
        return result;
    }

    static constexpr int rows() { return Rows; }
    static constexpr int columns() { return Columns; }
    constexpr Scalar& operator()(int row, int column) { return values_[at(row, column)]; }
    constexpr const Scalar& operator()(int row, int column) const { return values_[at(row, column)]; }
    /// Elements of a vector.
    constexpr Scalar& operator[](int index) { return values_[in_vector(index)]; }
    constexpr const Scalar& operator[](int index) const { return values_[in_vector(index)]; }
    constexpr View view() { return View(values_, Rows, Columns); }
    constexpr MatrixView<const Scalar> view() const { return {values_, Rows, Columns}; }

    constexpr Matrix<Columns, Rows, Scalar> transposed() const {
        Matrix<Columns, Rows, Scalar> result;
        for (int r = 0; r < Rows; ++r)
            for (int c = 0; c < Columns; ++c) result(c, r) = (*this)(r, c);
        return result;
    }
    constexpr Matrix<Rows, 1, Scalar> column(int index) const {
        Matrix<Rows, 1, Scalar> result;
        for (int r = 0; r < Rows; ++r) result[r] = (*this)(r, index);
        return result;
    }
    constexpr Matrix<Columns, 1, Scalar> row(int index) const {
        Matrix<Columns, 1, Scalar> result;
        for (int c = 0; c < Columns; ++c) result[c] = (*this)(index, c);
        return result;
    }

    friend constexpr Matrix operator+(Matrix a, const Matrix& b) { return a += b; }
    friend constexpr Matrix operator-(Matrix a, const Matrix& b) { return a -= b; }
    friend constexpr Matrix operator-(Matrix a) {
        for (Scalar& value : a.values_) value = -value;
        return a;
    }
    friend constexpr Matrix operator*(Matrix a, Scalar factor) {
        for (Scalar& value : a.values_) value = value * factor;
        return a;
    }
    friend constexpr Matrix operator*(Scalar factor, const Matrix& a) { return a * factor; }
    constexpr Matrix& operator+=(const Matrix& b) {
        for (int i = 0; i < Rows * Columns; ++i) values_[i] = values_[i] + b.values_[i];
        return *this;
    }
    constexpr Matrix& operator-=(const Matrix& b) {
        for (int i = 0; i < Rows * Columns; ++i) values_[i] = values_[i] - b.values_[i];
        return *this;
    }
    friend constexpr bool operator==(const Matrix& a, const Matrix& b) {
        for (int i = 0; i < Rows * Columns; ++i)
            if (a.values_[i] != b.values_[i]) return false;
        return true;
    }
    friend constexpr bool operator!=(const Matrix& a, const Matrix& b) { return !(a == b); }

private:
    static constexpr int at(int row, int column) {
        FOVEA_ASSERT(row >= 0 && row < Rows && column >= 0 && column < Columns);
        return row * Columns + column;
    }
    static constexpr int in_vector(int index) {
        static_assert(Rows == 1 || Columns == 1, "one index is for vectors");
        FOVEA_ASSERT(index >= 0 && index < Rows * Columns);
        return index;
    }

    Scalar values_[static_cast<std::size_t>(Rows * Columns)] = {};
};

/// A column.
template <int Count, class Scalar = Real>
using Vector = Matrix<Count, 1, Scalar>;

/// The product; each element is a sum in the order of the shared index.
template <int Rows, int Shared, int Columns, class Scalar>
constexpr Matrix<Rows, Columns, Scalar> operator*(const Matrix<Rows, Shared, Scalar>& a,
                                                  const Matrix<Shared, Columns, Scalar>& b);

/// The scalar product.
template <int Count, class Scalar>
constexpr Scalar dot(const Vector<Count, Scalar>& a, const Vector<Count, Scalar>& b);

/// The vector that stands on both.
template <class Scalar>
constexpr Vector<3, Scalar> cross(const Vector<3, Scalar>& a, const Vector<3, Scalar>& b) {
    return Vector<3, Scalar>(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
}

/// The Euclidean length.
template <int Count, class Scalar>
constexpr Scalar length_of(const Vector<Count, Scalar>& a) {
    return square_root(dot(a, a));
}

/// The vector at length 1.
///
/// Errors  degenerate for the vector 0
template <int Count, class Scalar>
constexpr Result<Vector<Count, Scalar>> normalized(const Vector<Count, Scalar>& a);

/// The matrix with which cross(a, b) is a product.
template <class Scalar>
constexpr Matrix<3, 3, Scalar> cross_matrix(const Vector<3, Scalar>& a) {
    const Scalar zero = scalar_of<Scalar>(0);
    return Matrix<3, 3, Scalar>(zero, -a[2], a[1], a[2], zero, -a[0], -a[1], a[0], zero);
}

template <class Scalar>
constexpr Scalar determinant(const Matrix<3, 3, Scalar>& a) {
    return dot(a.row(0), cross(a.row(1), a.row(2)));
}

/// The inverse by cofactors.
///
/// Errors  degenerate where the determinant is 0
template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> inverse(const Matrix<3, 3, Scalar>& a);

// ---- Implementation ---------------------------------------------------------------

template <int Rows, int Shared, int Columns, class Scalar>
constexpr Matrix<Rows, Columns, Scalar> operator*(const Matrix<Rows, Shared, Scalar>& a,
                                                  const Matrix<Shared, Columns, Scalar>& b) {
    Matrix<Rows, Columns, Scalar> result;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) {
            Scalar sum = a(r, 0) * b(0, c);
            for (int k = 1; k < Shared; ++k) sum = sum + a(r, k) * b(k, c);
            result(r, c) = sum;
        }
    return result;
}

template <int Count, class Scalar>
constexpr Scalar dot(const Vector<Count, Scalar>& a, const Vector<Count, Scalar>& b) {
    Scalar sum = a[0] * b[0];
    for (int i = 1; i < Count; ++i) sum = sum + a[i] * b[i];
    return sum;
}

template <int Count, class Scalar>
constexpr Result<Vector<Count, Scalar>> normalized(const Vector<Count, Scalar>& a) {
    const Scalar length = length_of(a);
    if (length == scalar_of<Scalar>(0)) return Status::degenerate;
    return a * (scalar_of<Scalar>(1) / length);
}

template <class Scalar>
constexpr Result<Matrix<3, 3, Scalar>> inverse(const Matrix<3, 3, Scalar>& a) {
    const Vector<3, Scalar> columns[3] = {cross(a.row(1), a.row(2)), cross(a.row(2), a.row(0)),
                                          cross(a.row(0), a.row(1))};
    const Scalar size = dot(a.row(0), columns[0]);
    if (size == scalar_of<Scalar>(0)) return Status::degenerate;
    Matrix<3, 3, Scalar> result;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) result(r, c) = columns[c][r] / size;
    return result;
}

}  // namespace fovea
