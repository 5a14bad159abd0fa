// SPDX-License-Identifier: MIT
//
// JpegFile: writes JPEG files segment by segment and block by block, right or deliberately wrong, for the
// tests of the decoder; and the transform of blocks by its definition.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/codec/jpeg_tables.hpp>
#include <fovea/image/geometry.hpp>

namespace fovea::test {

using Bytes = std::vector<std::uint8_t>;

inline Span<const std::uint8_t> span_of(const Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
inline Span<std::uint8_t> span_of(Bytes& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}

/// 64 quantised coefficients along the zigzag.
using Coefficients = std::vector<int>;

struct Sampling {
    int across = 1;
    int down = 1;
};

class JpegFile {
public:
    JpegFile() { marker(0xd8); }

    Bytes bytes;

    JpegFile& marker(int code) {
        bytes.push_back(0xff);
        bytes.push_back(static_cast<std::uint8_t>(code));
        return *this;
    }
    JpegFile& segment(int code, const Bytes& data) {
        marker(code);
        bytes.push_back(static_cast<std::uint8_t>((data.size() + 2) >> 8));
        bytes.push_back(static_cast<std::uint8_t>(data.size() + 2));
        bytes.insert(bytes.end(), data.begin(), data.end());
        return *this;
    }
    /// DQT: the same step for all coefficients.
    JpegFile& quantiser(int id, int step) {
        Bytes data(65, static_cast<std::uint8_t>(step));
        data[0] = static_cast<std::uint8_t>(id);
        return segment(0xdb, data);
    }
    /// SOFn of one component, or of three of which the last two have the factors of chroma.
    JpegFile& frame(Size size, int components, Sampling luma = {}, Sampling chroma = {}, int code = 0xc0,
                    int bits = 8) {
        Bytes data = {static_cast<std::uint8_t>(bits),        static_cast<std::uint8_t>(size.height >> 8),
                      static_cast<std::uint8_t>(size.height), static_cast<std::uint8_t>(size.width >> 8),
                      static_cast<std::uint8_t>(size.width),  static_cast<std::uint8_t>(components)};
        for (int c = 0; c < components; ++c) {
            const Sampling factors = c == 0 ? luma : chroma;
            data.push_back(static_cast<std::uint8_t>(c + 1));
            data.push_back(static_cast<std::uint8_t>(factors.across << 4 | factors.down));
            data.push_back(0);
        }
        return segment(code, data);
    }
    /// SOS with code 0 for the first component and code 1 for the others.
    JpegFile& scan(int components) {
        Bytes data = {static_cast<std::uint8_t>(components)};
        for (int c = 0; c < components; ++c) {
            data.push_back(static_cast<std::uint8_t>(c + 1));
            data.push_back(c == 0 ? 0x00 : 0x11);
        }
        data.insert(data.end(), {0, 63, 0});
        return segment(0xda, data);
    }
    /// DRI.
    JpegFile& restart_interval(int mcus) {
        return segment(0xdd, {static_cast<std::uint8_t>(mcus >> 8), static_cast<std::uint8_t>(mcus)});
    }

    /// Entropy-coded bits, given as '0' and '1'; anything else is passed over.
    JpegFile& bits(const char* text) {
        for (; *text != '\0'; ++text)
            if (*text == '0' || *text == '1') put(static_cast<unsigned>(*text - '0'), 1);
        return *this;
    }
    JpegFile& put(unsigned value, int count) {
        for (int i = count - 1; i >= 0; --i) {
            partial_ = partial_ << 1 | (value >> i & 1);
            if (++partial_bits_ < 8) continue;
            bytes.push_back(static_cast<std::uint8_t>(partial_));
            if (bytes.back() == 0xff) bytes.push_back(0);
            partial_ = 0;
            partial_bits_ = 0;
        }
        return *this;
    }
    /// Fills the last byte with ones.
    JpegFile& pad() {
        while (partial_bits_ > 0) put(1, 1);
        return *this;
    }
    /// One block in the standard codes of luma (0) or chroma (1). previous is the DC coefficient before.
    JpegFile& block(const Coefficients& quantised, int previous, int code) {
        put_value(jpeg::standard_dc_code[code], 0, quantised[0] - previous);
        int zeros = 0;
        for (std::size_t k = 1; k < 64; ++k) {
            if (quantised[k] == 0) {
                ++zeros;
                continue;
            }
            for (; zeros >= 16; zeros -= 16) put_word(jpeg::standard_ac_code[code], 0xf0);
            put_value(jpeg::standard_ac_code[code], zeros, quantised[k]);
            zeros = 0;
        }
        if (zeros > 0) put_word(jpeg::standard_ac_code[code], 0);
        return *this;
    }

private:
    /// The word of a symbol: T.81 figure C.2, written down anew.
    void put_word(Span<const std::uint8_t> code, int symbol) {
        unsigned word = 0;
        std::ptrdiff_t place = 16;
        for (int length = 1; length <= 16; ++length, word <<= 1)
            for (int i = 0; i < code[length - 1]; ++i, ++word, ++place)
                if (code[place] == symbol) {
                    put(word, length);
                    return;
                }
    }
    void put_value(Span<const std::uint8_t> code, int zeros, int value) {
        int size = 0;
        while ((value < 0 ? -value : value) >> size != 0) ++size;
        put_word(code, zeros << 4 | size);
        put(static_cast<unsigned>(value < 0 ? value - 1 : value) & ((1u << size) - 1), size);
    }

    unsigned partial_ = 0;
    int partial_bits_ = 0;
};

/// C(u) / 2 * cos((2 x + 1) u pi / 16), a factor of every term of the transform.
inline std::vector<double> make_waves() {
    std::vector<double> waves;
    for (int u = 0; u < 8; ++u)
        for (int x = 0; x < 8; ++x)
            waves.push_back((u == 0 ? std::sqrt(0.5) : 1.0) / 2 *
                            std::cos((2 * x + 1) * u * std::acos(-1.0) / 16));
    return waves;
}
inline const std::vector<double> waves = make_waves();
inline double wave(int u, int x) { return waves[static_cast<std::size_t>(8 * u + x)]; }

/// The definition, T.81 A.3.3.
inline std::vector<double> naive_inverse(const std::vector<double>& coefficients) {
    std::vector<double> samples(64);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            for (int v = 0; v < 8; ++v)
                for (int u = 0; u < 8; ++u)
                    samples[static_cast<std::size_t>(8 * y + x)] +=
                        coefficients[static_cast<std::size_t>(8 * v + u)] * wave(u, x) * wave(v, y);
    return samples;
}
inline std::vector<double> naive_forward(const std::vector<double>& samples) {
    std::vector<double> coefficients(64);
    for (int v = 0; v < 8; ++v)
        for (int u = 0; u < 8; ++u)
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x)
                    coefficients[static_cast<std::size_t>(8 * v + u)] +=
                        samples[static_cast<std::size_t>(8 * y + x)] * wave(u, x) * wave(v, y);
    return coefficients;
}

}  // namespace fovea::test
