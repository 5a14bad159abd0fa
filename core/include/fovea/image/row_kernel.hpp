// SPDX-License-Identifier: MIT
//
// Row kernels: the form of every neighbourhood operator. One kernel serves whole frames, strips of a frame
// and streams of rows, with the same bits in all of them.
//
// A row kernel is an object with
//     using Input = ...;   using Output = ...;         the pixels it reads and writes
//     int rows() const;                                the height of its window, odd
//     void operator()(const RowWindow<Input>& window, Output* dst);
// that makes one output row from the rows of its window. It may hold scratch, but nothing that survives a
// row; one that keeps what windows share has in place of that
//     void operator()(const RowWindow<Input>& window, bool follows, Output* dst);
// where follows says that the window is one row below that of the call before.
#pragma once

#include <type_traits>

#include <fovea/base/assert.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

namespace fovea {

/// The highest window of a row kernel; bounds the row pointers on the stack.
inline constexpr int max_window_rows = 63;

/// The rows of a window from top to bottom, each width pixels long. Rows beyond the image are already
/// replaced.
template <class Pixel>
class RowWindow {
public:
    RowWindow(const Pixel* const* rows, int count, int width) : rows_(rows), count_(count), width_(width) {}

    int count() const { return count_; }
    int width() const { return width_; }
    const Pixel* operator[](int index) const {
        FOVEA_ASSERT(index >= 0 && index < count_);
        return rows_[index];
    }

private:
    const Pixel* const* rows_;
    int count_;
    int width_;
};

namespace detail {

/// Makes a row by a kernel of either form.
template <class Kernel, class Input, class Output>
[[gnu::always_inline]] inline void make_row(Kernel& kernel, const RowWindow<Input>& window,
                                            [[maybe_unused]] bool follows, Output* dst) {
    if constexpr (std::is_invocable_v<Kernel&, const RowWindow<Input>&, bool, Output*>)
        kernel(window, follows, dst);
    else
        kernel(window, dst);
}

}  // namespace detail

/// Runs a row kernel over rows first..last of a frame, top to bottom; dst holds those rows alone.
///
/// Shapes   src as wide as dst; dst last - first + 1 rows
/// Border   rows beyond src as border says; the kernel does the columns. For Border::zero, zeros is a row
///          of them
/// Overlap  none
template <class Kernel>
void for_each_row(ImageView<const typename Kernel::Input> src, Border border, int first, int last,
                  Kernel& kernel, ImageView<typename Kernel::Output> dst,
                  const typename Kernel::Input* zeros = nullptr) {
    using Input = typename Kernel::Input;
    const int rows = kernel.rows();
    FOVEA_ASSERT(rows % 2 == 1 && rows <= max_window_rows && last - first < dst.height());
    FOVEA_ASSERT(border != Border::zero || zeros != nullptr);
    const Input* window[max_window_rows];
    for (int y = first; y <= last; ++y) {
        for (int i = 0; i < rows; ++i) {
            const int row = border_index(border, y - rows / 2 + i, src.height());
            window[i] = row == no_index ? zeros : src.row(row);
        }
        detail::make_row(kernel, RowWindow<Input>(window, rows, src.width()), y > first, dst.row(y - first));
    }
}

/// Runs a row kernel over a whole frame.
template <class Kernel>
void for_each_row(ImageView<const typename Kernel::Input> src, Border border, Kernel& kernel,
                  ImageView<typename Kernel::Output> dst, const typename Kernel::Input* zeros = nullptr) {
    for_each_row(src, border, 0, src.height() - 1, kernel, dst, zeros);
}

}  // namespace fovea
