// SPDX-License-Identifier: MIT
//
// The scan of a JPEG picture, one row of MCUs at a time: from entropy-coded bytes to samples. ITU-T T.81 A.2
// and F.2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/arena.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg_block.hpp>
#include <fovea/codec/jpeg_huffman.hpp>
#include <fovea/codec/jpeg_idct.hpp>
#include <fovea/codec/jpeg_markers.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

/// Where one row of MCUs puts the samples of a component. What stands over its right or lower edge is cut
/// off; a plane without memory takes nothing.
struct Plane {
    std::uint8_t* first = nullptr;
    std::ptrdiff_t stride_bytes = 0;
    int width = 0;
    int height = 0;
};

/// Decodes the entropy-coded data of a picture. header and the arena's memory must outlive it.
class ScanDecoder {
public:
    /// Bytes of the arena that the tables take.
    static constexpr std::int64_t scratch_bytes();

    ScanDecoder(const Header& header, Arena& arena);

    /// The next row of MCUs, planes[c] being that of component c.
    ///
    /// Errors  as decode_block(); malformed also for a restart marker that is missing, early, late or out of
    ///         turn
    Status mcu_row(const Plane (&planes)[max_components]);

    /// What follows the last row: ok for the end of the image, truncated if nothing does, malformed if
    /// anything else does. One restart marker that restarts nothing is passed over: there are programs that
    /// write it.
    Status finish() const;

private:
    Status mcu(int x, const Plane (&planes)[max_components]);
    Status restart();
    void put(const Plane& plane, int x, int y) const;

    const Header& header_;
    BitReader bits_;
    Span<HuffmanTable> dc_code_;
    Span<HuffmanTable> ac_code_;
    Span<Quantiser> quantiser_;
    Block block_;
    int dc_[max_components] = {};
    int until_restart_;  // MCUs
    int restarts_ = 0;
};

// ---- Implementation ---------------------------------------------------------------

constexpr std::int64_t ScanDecoder::scratch_bytes() {
    return 2 * arena_bytes<HuffmanTable>(2) + arena_bytes<Quantiser>(max_components);
}

inline ScanDecoder::ScanDecoder(const Header& header, Arena& arena)
    : header_(header),
      bits_(header.entropy),
      dc_code_(arena.take<HuffmanTable>(2)),
      ac_code_(arena.take<HuffmanTable>(2)),
      quantiser_(arena.take<Quantiser>(max_components)),
      until_restart_(header.restart_interval) {
    for (int i = 0; i < 2; ++i) {
        dc_code_[i].build(header.dc_code[i]);
        ac_code_[i].build(header.ac_code[i]);
    }
    for (int c = 0; c < header.components; ++c)
        quantiser_[c].build(header.quantiser[header.component[c].quantiser]);
}

inline Status ScanDecoder::mcu_row(const Plane (&planes)[max_components]) {
    const int mcus = header_.mcus_across();
    for (int x = 0; x < mcus; ++x) {
        if (header_.restart_interval > 0) {
            if (until_restart_ == 0)
                if (Status s = restart(); s != Status::ok) return s;
            --until_restart_;
        }
        if (Status s = mcu(x, planes); s != Status::ok) return s;
    }
    return Status::ok;
}

/// The blocks of a component row by row, then those of the next component. A.2.3.
inline Status ScanDecoder::mcu(int x, const Plane (&planes)[max_components]) {
    for (int c = 0; c < header_.components; ++c) {
        const Component& component = header_.component[c];
        for (int v = 0; v < component.down; ++v)
            for (int h = 0; h < component.across; ++h) {
                if (Status s = decode_block(bits_, dc_code_[component.dc_code], ac_code_[component.ac_code],
                                            quantiser_[c], dc_[c], block_);
                    s != Status::ok)
                    return s;
                put(planes[c], 8 * (x * component.across + h), 8 * v);
            }
    }
    return Status::ok;
}

inline void ScanDecoder::put(const Plane& plane, int x, int y) const {
    const int width = minimum(plane.width - x, 8);
    const int height = minimum(plane.height - y, 8);
    if (plane.first == nullptr || width <= 0 || height <= 0) return;
    std::uint8_t* to = plane.first + y * plane.stride_bytes + x;
    if (width == 8 && height == 8) return inverse_dct(block_, to, plane.stride_bytes);
    std::uint8_t whole[64];
    inverse_dct(block_, whole, 8);
    for (int row = 0; row < height; ++row)
        std::memcpy(to + row * plane.stride_bytes, whole + 8 * row, static_cast<std::size_t>(width));
}

/// F.2.1.3.1, E.2.4: RST0 to RST7 in turn, every one with the predictions at zero again.
inline Status ScanDecoder::restart() {
    const Result<Span<const std::uint8_t>> behind = bits_.marker_behind();
    if (!behind) return behind.status();
    MarkerReader markers(*behind);
    const Result<std::uint8_t> marker = markers.marker();
    if (!marker) return marker.status();
    if (*marker != first_restart + restarts_ % 8) return Status::malformed;
    ++restarts_;
    bits_ = BitReader(markers.rest());
    until_restart_ = header_.restart_interval;
    for (int& dc : dc_) dc = 0;
    return Status::ok;
}

inline Status ScanDecoder::finish() const {
    const Result<Span<const std::uint8_t>> behind = bits_.marker_behind();
    if (!behind) return behind.status();
    MarkerReader markers(*behind);
    Result<std::uint8_t> marker = markers.marker();
    if (marker && *marker >= first_restart && *marker < first_restart + 8) marker = markers.marker();
    if (!marker) return marker.status();
    return *marker == end_of_image ? Status::ok : Status::malformed;
}

}  // namespace fovea::jpeg
