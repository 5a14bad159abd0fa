// SPDX-License-Identifier: MIT
//
// The marker segments of a JPEG file up to its entropy-coded data. ITU-T T.81 Annex B.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/jpeg_huffman.hpp>
#include <fovea/codec/jpeg_tables.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::jpeg {

// ---- Interface --------------------------------------------------------------------

inline constexpr int max_components = 3;

/// One of the sampled planes of a picture. across and down are its sampling factors H and V, 1 or 2: the
/// blocks it has in every MCU.
struct Component {
    std::uint8_t id = 0;
    std::uint8_t across = 1;
    std::uint8_t down = 1;
    std::uint8_t quantiser = 0;
    std::uint8_t dc_code = 0;
    std::uint8_t ac_code = 0;
};

/// Everything in front of the entropy-coded data. The spans point into the file or to the standard codes.
struct Header {
    Size size;
    int components = 0;
    Component component[max_components];
    bool rgb = false;          ///< three components are red, green and blue, not luma and two chromas
    int restart_interval = 0;  ///< MCUs between two restart markers, 0 for none
    Span<const std::uint8_t> quantiser[4];  ///< 64 steps of one byte or of two, in zigzag order
    Span<const std::uint8_t> dc_code[2] = {standard_dc_code[0], standard_dc_code[1]};
    Span<const std::uint8_t> ac_code[2] = {standard_ac_code[0], standard_ac_code[1]};
    Span<const std::uint8_t> entropy;  ///< from the first entropy-coded byte to the end of the file

    /// The largest sampling factors, which are those of the first component.
    constexpr int across() const { return component[0].across; }
    constexpr int down() const { return component[0].down; }
    constexpr int mcus_across() const { return (size.width + 8 * across() - 1) / (8 * across()); }
    constexpr int mcus_down() const { return (size.height + 8 * down() - 1) / (8 * down()); }
    /// The samples of a component that stand for pixels of the picture. T.81 A.1.1.
    constexpr Size samples(const Component& of) const {
        return {(size.width * of.across + across() - 1) / across(),
                (size.height * of.down + down() - 1) / down()};
    }
    constexpr int blocks_per_mcu() const {
        int blocks = 0;
        for (int c = 0; c < components; ++c) blocks += component[c].across * component[c].down;
        return blocks;
    }
};

/// Reads and checks everything up to the first scan, which must hold all components.
///
/// Errors  truncated if the file ends first, or is too short for two bits a block, the least a picture can
///         take; malformed for what contradicts Annex B; image_too_large above max_image_side; unsupported
///         for progressive, lossless, hierarchical or arithmetic coding, other than 8 bits, other than 1 or 3
///         components, other samplings than 1x1, 2x1, 1x2 and 2x2, separate scans of the components, a height
///         that follows the scan (DNL), and more than two codes of a kind
/// Source  T.81 Annex B. Ss, Se, Ah and Al of the scan header are not looked at: a sequential scan does not
///         use them, and there are cameras that fill them wrongly. A code that no DHT segment defines is the
///         standard one of K.3: cameras of the USB video class send none
constexpr Result<Header> read_header(Span<const std::uint8_t> file);

/// Walks the segments of a file. Also finds the end of the picture behind the entropy-coded data.
class MarkerReader {
public:
    explicit constexpr MarkerReader(Span<const std::uint8_t> bytes) : bytes_(bytes) {}

    /// The code of the marker at the present place, fill bytes in front of it skipped. T.81 B.1.1.2.
    constexpr Result<std::uint8_t> marker();
    /// The bytes of the segment whose marker was just read, without its length. T.81 B.1.1.4.
    constexpr Result<Span<const std::uint8_t>> segment();
    constexpr Span<const std::uint8_t> rest() const { return bytes_.from(at_); }

private:
    Span<const std::uint8_t> bytes_;
    std::ptrdiff_t at_ = 0;
};

/// Marker codes, without the 0xff in front. T.81 Table B.1.
inline constexpr std::uint8_t first_restart = 0xd0;
inline constexpr std::uint8_t start_of_image = 0xd8;
inline constexpr std::uint8_t end_of_image = 0xd9;

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::uint8_t baseline_frame = 0xc0;
inline constexpr std::uint8_t extended_frame = 0xc1;
inline constexpr std::uint8_t huffman_codes = 0xc4;
inline constexpr std::uint8_t start_of_scan = 0xda;
inline constexpr std::uint8_t quantisers = 0xdb;
inline constexpr std::uint8_t restart_interval = 0xdd;
inline constexpr std::uint8_t comment = 0xfe;

/// A sum of H * V above this is not allowed in a scan of several components. T.81 B.2.3.
inline constexpr int max_blocks_per_mcu = 10;

constexpr int word_at(Span<const std::uint8_t> bytes, std::ptrdiff_t at) {
    return bytes[at] << 8 | bytes[at + 1];
}

constexpr bool starts_with(Span<const std::uint8_t> segment, const char* name) {
    std::ptrdiff_t i = 0;
    for (; name[i] != '\0'; ++i)
        if (i >= segment.size() || segment[i] != static_cast<std::uint8_t>(name[i])) return false;
    return true;
}

/// Collects a header segment by segment.
class HeaderReader {
public:
    explicit constexpr HeaderReader(Span<const std::uint8_t> file) : markers_(file) {}
    constexpr Result<Header> read();

private:
    constexpr Status segment(std::uint8_t marker, Span<const std::uint8_t> bytes);
    constexpr Status quantiser_segment(Span<const std::uint8_t> bytes);
    constexpr Status code_segment(Span<const std::uint8_t> bytes);
    constexpr Status restart_segment(Span<const std::uint8_t> bytes);
    constexpr Status frame(Span<const std::uint8_t> bytes);
    constexpr Status frame_components(Span<const std::uint8_t> bytes);
    constexpr Status sampling();
    constexpr Status scan(Span<const std::uint8_t> bytes);
    constexpr bool colours_are_rgb() const;

    MarkerReader markers_;
    Header header_;
    bool frame_seen_ = false;
    bool jfif_seen_ = false;
    int adobe_transform_ = -1;  // none seen
};

/// Annex B, figure B.2: what may stand between the start of the image and its first scan.
constexpr Status HeaderReader::segment(std::uint8_t marker, Span<const std::uint8_t> bytes) {
    constexpr std::uint8_t jfif = 0xe0;
    constexpr std::uint8_t adobe = 0xee;
    switch (marker) {
        case quantisers: return quantiser_segment(bytes);
        case huffman_codes: return code_segment(bytes);
        case restart_interval: return restart_segment(bytes);
        case baseline_frame:
        case extended_frame: return frame(bytes);
        case jfif: jfif_seen_ = jfif_seen_ || starts_with(bytes, "JFIF"); return Status::ok;
        case adobe:
            // The transform is the twelfth byte: 0 for RGB, 1 for YCbCr.
            if (bytes.size() >= 12 && starts_with(bytes, "Adobe")) adobe_transform_ = bytes[11];
            return Status::ok;
        default: return Status::ok;
    }
}

/// What to make of a marker that has no segment to be read here, ok for all that have one.
constexpr Status judge_marker(std::uint8_t marker) {
    if (marker == comment || (marker >= 0xe0 && marker <= 0xef)) return Status::ok;
    switch (marker) {
        case baseline_frame:
        case extended_frame:
        case huffman_codes:
        case start_of_scan:
        case quantisers:
        case restart_interval: return Status::ok;
        default: break;
    }
    // Other frames, arithmetic conditioning, hierarchical segments, extensions; B.1.1.3.
    const bool other_frame = marker >= 0xc2 && marker <= 0xcf;
    const bool hierarchical = marker == 0xde || marker == 0xdf;
    const bool extension = marker >= 0xf0 && marker <= 0xfd;
    return other_frame || hierarchical || extension ? Status::unsupported : Status::malformed;
}

constexpr Result<Header> HeaderReader::read() {
    const Result<std::uint8_t> start = markers_.marker();
    if (!start) return start.status();
    if (*start != start_of_image) return Status::malformed;
    for (;;) {
        const Result<std::uint8_t> marker = markers_.marker();
        if (!marker) return marker.status();
        if (Status s = judge_marker(*marker); s != Status::ok) return s;
        const Result<Span<const std::uint8_t>> bytes = markers_.segment();
        if (!bytes) return bytes.status();
        if (*marker == start_of_scan) {
            if (Status s = scan(*bytes); s != Status::ok) return s;
            return header_;
        }
        if (Status s = segment(*marker, *bytes); s != Status::ok) return s;
    }
}

/// B.2.4.1.
constexpr Status HeaderReader::quantiser_segment(Span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const int id = bytes[0] & 15;
        const int wide = bytes[0] >> 4;
        if (id > 3 || wide > 1) return Status::malformed;
        const std::ptrdiff_t length = wide == 1 ? 128 : 64;
        if (bytes.size() < 1 + length) return Status::malformed;
        const Span<const std::uint8_t> steps = bytes.from(1).first(length);
        for (std::ptrdiff_t k = 0; k < 64; ++k)
            if ((wide == 1 ? word_at(steps, 2 * k) : steps[k]) == 0) return Status::malformed;
        header_.quantiser[id] = steps;
        bytes = bytes.from(1 + length);
    }
    return Status::ok;
}

/// B.2.4.2.
constexpr Status HeaderReader::code_segment(Span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const int id = bytes[0] & 15;
        const int ac = bytes[0] >> 4;
        if (id > 3 || ac > 1) return Status::malformed;
        if (id > 1) return Status::unsupported;
        const Result<Span<const std::uint8_t>> code = read_code(bytes.from(1));
        if (!code) return code.status();
        // The symbols of a DC code are numbers of bits.
        for (std::ptrdiff_t i = max_code_bits; ac == 0 && i < code->size(); ++i)
            if ((*code)[i] > 15) return Status::malformed;
        (ac == 1 ? header_.ac_code : header_.dc_code)[id] = *code;
        bytes = bytes.from(1 + code->size());
    }
    return Status::ok;
}

/// B.2.4.4.
constexpr Status HeaderReader::restart_segment(Span<const std::uint8_t> bytes) {
    if (bytes.size() != 2) return Status::malformed;
    header_.restart_interval = word_at(bytes, 0);
    return Status::ok;
}

/// B.2.2.
constexpr Status HeaderReader::frame(Span<const std::uint8_t> bytes) {
    if (frame_seen_ || bytes.size() < 6) return Status::malformed;
    frame_seen_ = true;
    if (bytes[0] == 12) return Status::unsupported;
    if (bytes[0] != 8) return Status::malformed;
    header_.size = {word_at(bytes, 3), word_at(bytes, 1)};
    header_.components = bytes[5];
    if (header_.size.width == 0 || header_.components == 0 || bytes.size() != 6 + 3 * header_.components)
        return Status::malformed;
    if (header_.size.height == 0) return Status::unsupported;
    if (header_.size.width > max_image_side || header_.size.height > max_image_side)
        return Status::image_too_large;
    if (header_.components != 1 && header_.components != 3) return Status::unsupported;
    return frame_components(bytes.from(6));
}

constexpr Status HeaderReader::frame_components(Span<const std::uint8_t> bytes) {
    for (int c = 0; c < header_.components; ++c) {
        const Span<const std::uint8_t> from = bytes.from(3 * c);
        Component& component = header_.component[c];
        component.id = from[0];
        component.across = from[1] >> 4;
        component.down = from[1] & 15;
        component.quantiser = from[2];
        if (component.across < 1 || component.across > 4 || component.down < 1 || component.down > 4 ||
            component.quantiser > 3)
            return Status::malformed;
        for (int other = 0; other < c; ++other)
            if (header_.component[other].id == component.id) return Status::malformed;
    }
    return sampling();
}

constexpr Status HeaderReader::sampling() {
    Component& luma = header_.component[0];
    if (header_.components == 1) {
        // A scan of one component is a plain sequence of blocks, whatever its factors: A.2.2.
        luma.across = luma.down = 1;
        return Status::ok;
    }
    const Component& blue = header_.component[1];
    const Component& red = header_.component[2];
    if (luma.across > 2 || luma.down > 2 || blue.across > luma.across || blue.down > luma.down ||
        blue.across != red.across || blue.down != red.down)
        return Status::unsupported;
    return header_.blocks_per_mcu() > max_blocks_per_mcu ? Status::malformed : Status::ok;
}

/// B.2.3.
constexpr Status HeaderReader::scan(Span<const std::uint8_t> bytes) {
    if (!frame_seen_ || bytes.empty()) return Status::malformed;
    const int components = bytes[0];
    if (components < 1 || components > header_.components || bytes.size() != 4 + 2 * components)
        return Status::malformed;
    if (components != header_.components) return Status::unsupported;
    for (int c = 0; c < components; ++c) {
        Component& component = header_.component[c];
        const int dc = bytes[2 + 2 * c] >> 4;
        const int ac = bytes[2 + 2 * c] & 15;
        if (bytes[1 + 2 * c] != component.id || dc > 3 || ac > 3) return Status::malformed;
        if (dc > 1 || ac > 1) return Status::unsupported;
        if (header_.quantiser[component.quantiser].empty()) return Status::malformed;
        component.dc_code = static_cast<std::uint8_t>(dc);
        component.ac_code = static_cast<std::uint8_t>(ac);
    }
    header_.rgb = colours_are_rgb();
    header_.entropy = markers_.rest();
    // Every block has a DC and an AC code of one bit at least. At most 2^24 MCUs of 10 blocks.
    const std::int64_t blocks =
        std::int64_t{header_.mcus_across()} * header_.mcus_down() * header_.blocks_per_mcu();
    return header_.entropy.size() < blocks / 4 ? Status::truncated : Status::ok;
}

/// A JFIF file is YCbCr; else Adobe's marker says; else the letters R, G, B as identifiers do.
constexpr bool HeaderReader::colours_are_rgb() const {
    if (header_.components != 3 || jfif_seen_) return false;
    if (adobe_transform_ >= 0) return adobe_transform_ == 0;
    return header_.component[0].id == 'R' && header_.component[1].id == 'G' && header_.component[2].id == 'B';
}

}  // namespace detail

constexpr Result<std::uint8_t> MarkerReader::marker() {
    const Span<const std::uint8_t> bytes = rest();
    std::ptrdiff_t i = 0;
    while (i < bytes.size() && bytes[i] == 0xff) ++i;
    if (i == bytes.size()) return Status::truncated;
    if (i == 0 || bytes[i] == 0) return Status::malformed;
    at_ += i + 1;
    return bytes[i];
}

constexpr Result<Span<const std::uint8_t>> MarkerReader::segment() {
    const Span<const std::uint8_t> bytes = rest();
    if (bytes.size() < 2) return Status::truncated;
    const int length = detail::word_at(bytes, 0);
    if (length < 2) return Status::malformed;
    if (bytes.size() < length) return Status::truncated;
    at_ += length;
    return bytes.first(length).from(2);
}

constexpr Result<Header> read_header(Span<const std::uint8_t> file) {
    return detail::HeaderReader(file).read();
}

}  // namespace fovea::jpeg
