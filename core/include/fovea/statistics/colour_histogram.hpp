// SPDX-License-Identifier: MIT
//
// Histogram of hue and saturation, for colours to be recognised by. Book sec. 2.5.2.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/integer.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Pixels that say nothing about colour: of a grey one the hue is chance, of a dark one the saturation too.
struct ColourFloors {
    Gray8 saturation = 32;  ///< least saturation that counts; higher leaves more of pale parts out
    Gray8 value = 32;       ///< least value that counts; higher leaves more of shadows out
};

/// How often each hue and saturation occurs. An accumulator: it takes rows in any number of calls, or those
/// of a stream.
///
/// Units   counts of pixels, at most 2^32 - 1 in all. HueBins share the 180 hues, SaturationBins the 256
///         saturations; bin i of n holds the values v with i = n v / 180 or n v / 256, rounded down. A hue
///         above 179 counts as 179
/// Memory  4 bytes a bin; on 64-bit processors four times that up to 1024 bins
/// Source  book sec. 2.5.2
template <int HueBins = 18, int SaturationBins = 8>
class HueSaturationHistogram {
public:
    static_assert(HueBins >= 1 && HueBins <= 180, "there are 180 hues");
    static_assert(SaturationBins >= 1 && SaturationBins <= 256, "there are 256 saturations");

    using Input = Hsv888;
    static constexpr int hues = HueBins;
    static constexpr int saturations = SaturationBins;

    constexpr HueSaturationHistogram() = default;
    constexpr explicit HueSaturationHistogram(ColourFloors floors) : floors_(floors) {}

    /// Adds the pixels of a row that are not below the floors.
    constexpr void add_row(const Hsv888* row, int width) {
        int x = 0;
        if constexpr (tables == 4)
            for (; x + 4 <= width; x += 4) {
                count(row[x], counts_[0]);
                count(row[x + 1], counts_[1]);
                count(row[x + 2], counts_[2]);
                count(row[x + 3], counts_[3]);
            }
        for (; x < width; ++x) count(row[x], counts_[0]);
    }
    /// As the accumulator of a stream: cleared for every image.
    constexpr Status begin(Size) {
        clear();
        return Status::ok;
    }
    constexpr void add_row(const Hsv888* row, int width, int) { add_row(row, width); }
    /// Adds the counts of other rows, which had the same floors: of another strip of a frame.
    constexpr void merge(const HueSaturationHistogram& other) {
        for (int bin = 0; bin < size(); ++bin) counts_[0][bin] += other[bin];
    }
    static constexpr int hue_bin(Gray8 hue) { return minimum<int>(hue, 179) * HueBins / 180; }
    static constexpr int saturation_bin(Gray8 saturation) { return saturation * SaturationBins / 256; }

    /// Bins in all.
    constexpr int size() const { return HueBins * SaturationBins; }
    /// The count of a bin; the bins of a hue follow each other.
    constexpr std::uint32_t operator[](int bin) const {
        FOVEA_ASSERT(bin >= 0 && bin < size());
        std::uint32_t sum = 0;
        for (const auto& table : counts_) sum += table[bin];
        return sum;
    }
    constexpr std::uint32_t at(int hue, int saturation) const {
        FOVEA_ASSERT(hue >= 0 && hue < HueBins && saturation >= 0 && saturation < SaturationBins);
        return (*this)[hue * SaturationBins + saturation];
    }
    /// The pixels that counted.
    constexpr std::uint32_t total() const {
        std::uint32_t sum = 0;
        for (int bin = 0; bin < size(); ++bin) sum += (*this)[bin];
        return sum;
    }
    constexpr void clear() {
        for (auto& table : counts_)
            for (std::uint32_t& count : table) count = 0;
    }

private:
    // As in Histogram: colours come in patches, and a pixel need not wait until its like before it is
    // counted.
    static constexpr std::size_t tables = sizeof(void*) >= 8 && HueBins * SaturationBins <= 1024 ? 4 : 1;

    /// The first bin of every hue.
    struct FirstBins {
        std::uint16_t of[256]{};
        constexpr FirstBins() {
            for (int hue = 0; hue < 256; ++hue)
                of[hue] = static_cast<std::uint16_t>(hue_bin(static_cast<Gray8>(hue)) * SaturationBins);
        }
    };
    static constexpr FirstBins first_bins{};
    using Table = std::uint32_t[static_cast<std::size_t>(HueBins) * SaturationBins];

    constexpr void count(const Hsv888& pixel, Table& table) const {
        // Added, so that no branch is guessed wrong: 1 where neither is below its floor.
        const int below = (pixel.saturation - floors_.saturation) | (pixel.value - floors_.value);
        const auto bin = static_cast<std::size_t>(saturation_bin(pixel.saturation));
        table[first_bins.of[pixel.hue] + bin] += ~static_cast<std::uint32_t>(below) >> 31;
    }

    ColourFloors floors_;
    std::uint32_t counts_[tables][static_cast<std::size_t>(HueBins) * SaturationBins]{};
};

/// The histogram of a whole image.
///
/// Shapes  src 1x1 or larger
/// Errors  empty_image, with histogram untouched
/// Source  book sec. 2.5.2
template <int HueBins, int SaturationBins>
constexpr Status histogram_of(ImageView<const Hsv888> src,
                              HueSaturationHistogram<HueBins, SaturationBins>& histogram) {
    if (src.empty()) return Status::empty_image;
    histogram.clear();
    for (int y = 0; y < src.height(); ++y) histogram.add_row(src.row(y), src.width());
    return Status::ok;
}

}  // namespace fovea
