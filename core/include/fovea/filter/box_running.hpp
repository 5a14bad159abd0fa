// SPDX-License-Identifier: MIT
//
// The row kernel of box() without wide vectors: sums of columns, and their sum, which runs along the row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/simd/column_sums.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {
inline namespace FOVEA_ISA {
namespace kernels {

/// follows says that the window is one row below that of the call before: then a column's sum has lost the
/// row that left, and gains the new one.
class BoxRunningRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    static constexpr std::int64_t scratch(int width) {
        return arena_bytes<std::uint16_t>(room(width)) + arena_bytes<std::uint16_t>(width);
    }

    BoxRunningRow() = default;
    BoxRunningRow(Size element, Border border, Span<std::uint8_t> scratch, int width)
        : element_(element), border_(border) {
        Arena arena(scratch);
        columns_ = arena.take<std::uint16_t>(room(width)).data() + margin;
        remaining_ = arena.take<std::uint16_t>(width).data();
    }

    int rows() const { return element_.height; }

    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        const int width = window.width();
        const auto area = static_cast<std::uint32_t>(element_.width * element_.height);
        if (area == 1) {
            std::memcpy(dst, window[0], static_cast<std::size_t>(width));
            return;
        }
        if (!follows) sum_remaining(window, width);
        simd::sum_columns(window[0], window[window.count() - 1], width, remaining_, columns_);
        continue_ends(width);
        // The column before the window of the first pixel is in its sum until it leaves.
        const int reach = element_.width / 2;
        const std::uint16_t* leaving = columns_ - reach - 1;
        std::uint32_t sum = area / 2;
        for (int x = 0; x < element_.width; ++x) sum += leaving[x];
        // Less than area too much for 2^32 of them, and sums are below 2^20: exact.
        simd::running_means(columns_ + reach, leaving, width, sum, 0xffffffffu / area + 1, dst);
    }

private:
    static constexpr int margin = (max_window_rows + 1) / 2;
    static_assert(max_window_rows * 255 < 1 << 15);
    static constexpr int room(int width) { return width + 2 * margin; }

    void sum_remaining(const RowWindow<Gray8>& window, int width) {
        for (int x = 0; x < width; ++x) {
            int sum = 0;
            for (int i = 0; i < window.count() - 1; ++i) sum += window[i][x];
            remaining_[x] = static_cast<std::uint16_t>(sum);
        }
    }
    void continue_ends(int width) {
        for (int i = 1; i <= element_.width / 2; ++i)
            for (const int x : {-i, width - 1 + i}) {
                const int column = border_index(border_, x, width);
                columns_[x] = column == no_index ? std::uint16_t{0} : columns_[column];
            }
    }

    Size element_{1, 1};
    Border border_ = Border::replicate;
    std::uint16_t* columns_ = nullptr;    ///< sums, margin more on either side
    std::uint16_t* remaining_ = nullptr;  ///< without the first row of the window
};

}  // namespace kernels
}  // namespace FOVEA_ISA
}  // namespace fovea
