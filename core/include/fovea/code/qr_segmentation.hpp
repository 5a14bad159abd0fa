// SPDX-License-Identifier: MIT
//
// Which mode of a QR code writes which bytes of a text in the fewest bits. ISO/IEC 18004, annex J.
#pragma once

#include <cstdint>
#include <limits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/qr_tables.hpp>

namespace fovea::detail {

/// Where a character stands among the 45 of the alphanumeric mode, or -1.
constexpr int qr_alphanumeric_value(std::uint8_t byte) {
    for (int i = 0; i < 45; ++i) {
        if (byte == static_cast<unsigned char>(qr_alphanumeric[i])) return i;
    }
    return -1;
}
constexpr bool fits_qr_mode(QrMode mode, std::uint8_t byte) {
    if (mode == QrMode::numeric) return byte >= '0' && byte <= '9';
    return mode == QrMode::bytes || (mode == QrMode::alphanumeric && qr_alphanumeric_value(byte) >= 0);
}

/// Bits that count characters of a mode take, without their header.
constexpr std::int64_t qr_data_bits(QrMode mode, std::int64_t count) {
    if (mode == QrMode::numeric) return count / 3 * 10 + (count % 3 == 0 ? 0 : count % 3 * 3 + 1);
    if (mode == QrMode::alphanumeric) return count / 2 * 11 + count % 2 * 6;
    return count * 8;
}

/// Bits that tell an interpretation. Clause 7.4.2, table 4.
constexpr int qr_eci_bits(int eci) {
    return eci == TextSegment::not_stated ? 0 : eci < 128 ? 12 : eci < 16384 ? 20 : 28;
}

/// The modes of a text, the cheapest for the versions of a class: ways has as many bytes as text, and says of
/// every byte in bits 2m and 2m+1 from which mode one comes that writes it in mode m, and in bits 6 and 7,
/// when all is done, the mode. Costs are in sixths of a bit, as ten bits are three digits and eleven two
/// characters; at most 2^13 bytes cost below 2^20.
class QrSegmentation {
public:
    QrSegmentation(Span<const std::uint8_t> text, Span<std::uint8_t> ways, int version)
        : text_(text), ways_(ways), version_(version) {
        choose();
    }

    QrMode mode(std::ptrdiff_t index) const { return static_cast<QrMode>(ways_[index] >> 6); }
    /// The end of the run of one mode that begins at a byte. A run is no longer than its count can tell.
    std::ptrdiff_t run_end(std::ptrdiff_t first) const {
        const std::ptrdiff_t most = (std::ptrdiff_t{1} << qr_count_bits_of(mode(first), version_)) - 1;
        std::ptrdiff_t end = first;
        while (end < text_.size() && end - first < most && mode(end) == mode(first)) ++end;
        return end;
    }
    std::int64_t bits() const {
        std::int64_t sum = 0;
        for (std::ptrdiff_t first = 0; first < text_.size();) {
            const std::ptrdiff_t end = run_end(first);
            sum += 4 + qr_count_bits_of(mode(first), version_) + qr_data_bits(mode(first), end - first);
            first = end;
        }
        return sum;
    }

private:
    static constexpr int modes = 3;
    static constexpr int impossible = std::numeric_limits<int>::max() / 2;
    static constexpr int sixths[modes] = {20, 33, 48};

    void choose() {
        int cost[modes] = {};
        for (int m = 0; m < modes; ++m) cost[m] = header(m);
        for (std::ptrdiff_t i = 0; i < text_.size(); ++i) {
            int within[modes] = {};
            for (int m = 0; m < modes; ++m) {
                const bool fits = fits_qr_mode(static_cast<QrMode>(m), text_[i]);
                within[m] = fits && cost[m] < impossible ? cost[m] + sixths[m] : impossible;
            }
            // cost becomes that of writing the next byte in a mode: going on, or after this byte in another.
            int way = 0;
            for (int m = 0; m < modes; ++m) {
                int from = m;
                int best = within[m];
                for (int other = 0; other < modes; ++other) {
                    // A header begins at a whole bit.
                    const int changed = (within[other] + 5) / 6 * 6 + header(m);
                    if (other != m && within[other] < impossible && changed < best) {
                        best = changed;
                        from = other;
                    }
                }
                cost[m] = best;
                way |= from << (2 * m);
            }
            ways_[i] = static_cast<std::uint8_t>(way);
            if (i == text_.size() - 1) {
                int last = 0;
                for (int m = 1; m < modes; ++m) last = within[m] < within[last] ? m : last;
                go_back(last);
            }
        }
    }
    /// ways_[i] says in which mode byte i was written if byte i + 1 is in mode m.
    void go_back(int mode) {
        for (std::ptrdiff_t i = text_.size() - 1; i >= 0; --i) {
            if (i < text_.size() - 1) mode = ways_[i] >> (2 * mode) & 3;
            ways_[i] = static_cast<std::uint8_t>((ways_[i] & 0x3F) | mode << 6);
        }
    }
    int header(int mode) const { return (4 + qr_count_bits_of(static_cast<QrMode>(mode), version_)) * 6; }

    Span<const std::uint8_t> text_;
    Span<std::uint8_t> ways_;
    int version_;
};

}  // namespace fovea::detail
