// SPDX-License-Identifier: MIT
//
// Digest: the checksum of an operator's outputs. Every value is written out number by number, never as it
// lies in memory, so that all machines have the same bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/crc32.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/real.hpp>

namespace fovea::golden {

/// CRC-32 over numbers of 64 bits, lowest byte first, and over the bytes of pixels.
class Digest {
public:
    /// Adds each value by the put() of its type.
    template <class... Values>
    void add(const Values&... values) {
        (put(*this, values), ...);
    }
    void add_byte(std::uint8_t byte) { crc_.add(byte); }
    void add_number(std::int64_t number) {
        const auto bits = static_cast<std::uint64_t>(number);
        for (int i = 0; i < 64; i += 8) crc_.add(static_cast<std::uint8_t>(bits >> i & 255));
    }
    std::uint32_t value() const { return crc_.value(); }

private:
    Crc32 crc_;
};

template <class Number, class = std::enable_if_t<std::is_integral_v<Number> || std::is_enum_v<Number>>>
void put(Digest& digest, Number number) {
    digest.add_number(static_cast<std::int64_t>(number));
}
template <class Rep, int FractionBits>
void put(Digest& digest, Fixed<Rep, FractionBits> number) {
    digest.add_number(number.raw());
}
inline void put(Digest& digest, Angle angle) { digest.add_number(angle.raw()); }
inline void put(Digest& digest, FineAngle angle) { digest.add_number(angle.raw()); }
inline void put(Digest& digest, Decimal number) { digest.add_number(number.millionths); }
inline void put(Digest& digest, Int128 number) { digest.add(number.low_word(), (number >> 64).low_word()); }

inline void put(Digest& digest, Real number) {
    digest.add(number.mantissa(), number.exponent(), number.negative());
}

inline void put(Digest& digest, Size size) { digest.add(size.width, size.height); }
inline void put(Digest& digest, Point point) { digest.add(point.x, point.y); }
inline void put(Digest& digest, SubPixelPoint point) { digest.add(point.x, point.y); }
inline void put(Digest& digest, FinePoint point) { digest.add(point.x, point.y); }
inline void put(Digest& digest, Rectangle area) { digest.add(area.x, area.y, area.width, area.height); }

inline void put(Digest& digest, Rgb888 colour) {
    digest.add_byte(colour.red);
    digest.add_byte(colour.green);
    digest.add_byte(colour.blue);
}

/// The answer, or why there is none.
template <class T>
void put(Digest& digest, const Result<T>& result) {
    digest.add(result.status());
    if (result.ok()) digest.add(*result);
}

/// The elements and how many there are; bytes and characters as bytes.
template <class T>
void put(Digest& digest, Span<T> elements) {
    digest.add(elements.size());
    for (const auto& element : elements) {
        if constexpr (sizeof(T) == 1)
            digest.add_byte(static_cast<std::uint8_t>(element));
        else
            digest.add(element);
    }
}
template <class T>
void put(Digest& digest, ListView<T> list) {
    digest.add(list.span());
}

/// Size and pixels, without what stands between the rows.
template <class Pixel>
void put(Digest& digest, ImageView<Pixel> image) {
    digest.add(image.size());
    for (int y = 0; y < image.height(); ++y)
        for (int x = 0; x < image.width(); ++x) {
            if constexpr (sizeof(Pixel) == 1)
                digest.add_byte(image(x, y));
            else
                digest.add(image(x, y));
        }
}

/// A text that ends with a zero.
inline void put_text(Digest& digest, const char* text) {
    for (; *text != '\0'; ++text) digest.add_byte(static_cast<std::uint8_t>(*text));
    digest.add_byte(0);
}

}  // namespace fovea::golden
