// SPDX-License-Identifier: MIT
//
// How well a QR code is printed and seen, as far as a gray image tells. ISO/IEC 15415.
#pragma once

#include <cstdint>
#include <initializer_list>

#include <fovea/base/span.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/qr_decode.hpp>
#include <fovea/code/qr_locate.hpp>
#include <fovea/code/qr_matrix.hpp>
#include <fovea/code/qr_sample.hpp>
#include <fovea/code/qr_tables.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// 4 for what is at least the first of four limits, down to 0 for less than the last.
constexpr std::int8_t grade_of(int value, int four, int three, int two, int one) {
    return static_cast<std::int8_t>(value >= four    ? 4
                                    : value >= three ? 3
                                    : value >= two   ? 2
                                    : value >= one   ? 1
                                                     : 0);
}

/// Grades one symbol that was read.
///
/// Source  ISO/IEC 15415, 7.8: contrast against the 255 levels of the image instead of a calibrated white;
///         modulation by the middle of each module, and without knowing which codewords were mended. The
///         quiet zone by how many of its four modules are light all around: those outside of the image are
///         not
class QrGrader {
public:
    QrGrader(ImageView<const Gray8> image, const ModulePlane& plane, const GrayModules& levels,
             const QrSymbol& symbol, bool inverted)
        : image_(image),
          plane_(plane),
          levels_(levels),
          symbol_(symbol),
          inverted_(inverted),
          size_(qr_size(symbol.version)) {}

    /// room holds a byte for every codeword.
    CodeGrade grade(Span<std::uint8_t> room) {
        find_extremes();
        CodeGrade grade;
        grade.symbol_contrast = grade_of((high_ - low_) * 100 / 255 / 16, 70, 55, 40, 20);
        grade.modulation = modulation(room);
        grade.quiet_zone = quiet_zone();
        grade.unused_error_correction = grade_of(symbol_.unused_correction, 62, 50, 37, 25);
        grade.overall = minimum(minimum(grade.symbol_contrast, grade.modulation),
                                minimum(grade.quiet_zone, grade.unused_error_correction));
        return grade;
    }

private:
    void find_extremes() {
        for (int y = 0; y < size_; ++y) {
            for (int x = 0; x < size_; ++x) {
                low_ = minimum(low_, levels_.level(x, y));
                high_ = maximum(high_, levels_.level(x, y));
            }
        }
    }
    /// Percent of half the contrast that a module is away from the middle between the extremes.
    int modulation_at(int x, int y) const {
        const int twice_off = 2 * levels_.level(x, y) - (low_ + high_);
        const int contrast = maximum(high_ - low_, 1);
        return (twice_off < 0 ? -twice_off : twice_off) * 100 / contrast;
    }
    /// The best level of which the codewords that miss it are few enough: as erasures they leave so much
    /// unused correction that its grade is no lower.
    std::int8_t modulation(Span<std::uint8_t> room) const {
        const Span<std::uint8_t> least = room.first(qr_codewords(symbol_.version));
        for (std::uint8_t& value : least) value = 100;
        along_qr_codewords(QrPatterns(symbol_.version), [&](int x, int y, int index) {
            if (index / 8 >= least.size()) return;
            const int column = symbol_.mirrored ? y : x;
            const int row = symbol_.mirrored ? x : y;
            std::uint8_t& value = least[index / 8];
            value = static_cast<std::uint8_t>(minimum<int>(value, modulation_at(column, row)));
        });
        std::int8_t best = 0;
        for (std::int8_t level = 1; level <= 4; ++level) {
            constexpr int limits[5] = {0, 20, 30, 40, 50};
            best = maximum(best, minimum(level, correction_left(least, limits[level])));
        }
        return best;
    }
    std::int8_t correction_left(Span<const std::uint8_t> least, int limit) const {
        const QrBlocks blocks = qr_blocks(symbol_.version, symbol_.level);
        const int correcting = blocks.parity - qr_misdecode_reserve(symbol_.version, symbol_.level);
        int worst = 100;
        for (int b = 0; b < blocks.blocks; ++b) {
            int missed = 0;
            for (int i = 0; i < blocks.data(b) + blocks.parity; ++i) {
                if (least[blocks.place(b, i)] < limit) ++missed;
            }
            worst = minimum(worst, 100 - missed * 100 / correcting);
        }
        return grade_of(worst, 62, 50, 37, 25);
    }
    std::int8_t quiet_zone() const {
        constexpr int rings = 4;
        for (int ring = 1; ring <= rings; ++ring) {
            const int low = -ring;
            const int high = size_ - 1 + ring;
            int dark = 0;
            for (int i = low; i < high; ++i) {
                for (const ModulePoint module : {module_centre(i, low), module_centre(high, i),
                                                 module_centre(low, i + 1), module_centre(i + 1, high)})
                    dark += light(plane_(module)) ? 0 : 1;
            }
            // A twentieth is noise.
            if (dark * 20 > 4 * (high - low)) return static_cast<std::int8_t>(ring - 1);
        }
        return rings;
    }
    bool light(ModulePoint place) const {
        const ModulePoint last = pixel_place(image_.width() - 1, image_.height() - 1);
        // Pixels reach half a pixel beyond their centres.
        if (place.x < -128 || place.y < -128 || place.x > last.x + 128 || place.y > last.y + 128)
            return false;
        const bool bright = brightness(image_, place) / 8 > low_ + high_;
        return bright != inverted_;
    }

    ImageView<const Gray8> image_;
    const ModulePlane& plane_;
    const GrayModules& levels_;
    const QrSymbol& symbol_;
    bool inverted_;
    int size_;
    int low_ = 255 * 16;  ///< 1/16 level
    int high_ = 0;
};

}  // namespace fovea::detail
