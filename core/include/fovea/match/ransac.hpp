// SPDX-License-Identifier: MIT
//
// RANSAC: the model that most of the data agree with, whatever the others are.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/real.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// How long to draw, and what is enough.
struct RansacOptions {
    std::uint64_t seed = 1;     ///< the same seed gives the same answer
    int most_samples = 2000;    ///< at most so many samples are drawn
    int miss_bits = 10;         ///< drawing ends when the best sample was missed with at most 2^-miss_bits
    std::ptrdiff_t enough = 0;  ///< so many must agree at least; 0 is one more than a sample has
};

/// The best model of a sample.
template <class Model>
struct RansacResult {
    Model model;
    std::ptrdiff_t agreeing = 0;
    int samples = 0;       ///< drawn
    bool certain = false;  ///< that the miss is as rare as asked; if not, most_samples were drawn before
};

/// How many samples miss all those of agreeing data alone with at most 2^-miss_bits; most if more than those.
///
/// Source  1 - w^s to the power of k; Fischler and Bolles, "Random Sample Consensus", CACM 24(6), 1981, sec.
///         II.A, with a sample's data drawn without putting back
constexpr int ransac_samples(std::ptrdiff_t agreeing, std::ptrdiff_t count, int sample_size, int miss_bits,
                             int most);

/// Makes models of samples and keeps the one with which most data agree; of equals, the first.
///
/// make     Result<Model> from SampleSize indices, ascending and different: const std::ptrdiff_t (&)[N]
/// agrees   bool of a model and an index
/// Errors   bad_argument for options out of range (most_samples 1 to 2^20, miss_bits 1 to 60, enough not
///          negative) or for fewer data than a sample has; not_found if fewer than enough agree with any;
///          degenerate if no sample makes a model
/// Source   Fischler and Bolles
template <int SampleSize, class Model, class Make, class Agrees>
constexpr Result<RansacResult<Model>> ransac(std::ptrdiff_t count, const RansacOptions& options, Make make,
                                             Agrees agrees);

// ---- Implementation ---------------------------------------------------------------

constexpr int ransac_samples(std::ptrdiff_t agreeing, std::ptrdiff_t count, int sample_size, int miss_bits,
                             int most) {
    if (agreeing < sample_size) return most;
    Real good = Real::one();
    for (int i = 0; i < sample_size; ++i)
        good = good * (Real::from_int(agreeing - i) / Real::from_int(count - i));
    const Real miss = Real::one() - good;
    const Real target = Real::one().scaled(-miss_bits);
    // Powers of miss: to 1, 2, 4, ... until one is small enough, and from there down by halves.
    Real powers[21];
    int bits = 0;
    powers[0] = miss;
    while (target < powers[bits]) {
        if ((1 << bits) >= most || bits == 20) return most;
        powers[bits + 1] = powers[bits] * powers[bits];
        ++bits;
    }
    // The largest count whose miss is still too large, plus one.
    Real so_far = Real::one();
    int drawn = 0;
    for (int i = bits - 1; i >= 0; --i) {
        const Real next = so_far * powers[i];
        if (!(target < next)) continue;
        so_far = next;
        drawn += 1 << i;
    }
    return drawn + 1 < most ? drawn + 1 : most;
}

template <int SampleSize, class Model, class Make, class Agrees>
constexpr Result<RansacResult<Model>> ransac(std::ptrdiff_t count, const RansacOptions& options, Make make,
                                             Agrees agrees) {
    static_assert(SampleSize > 0, "a sample has data");
    if (options.most_samples < 1 || options.most_samples > 1 << 20 || options.miss_bits < 1 ||
        options.miss_bits > 60 || options.enough < 0 || count < SampleSize ||
        static_cast<std::uint64_t>(count) > 0xffffffff)
        return Status::bad_argument;
    const std::ptrdiff_t enough = options.enough > 0 ? options.enough : SampleSize + 1;
    Random random(options.seed);
    RansacResult<Model> best{};
    bool any = false;
    int needed = options.most_samples;
    int drawn = 0;
    for (; drawn < needed; ++drawn) {
        std::ptrdiff_t chosen[static_cast<std::size_t>(SampleSize)] = {};
        draw_different(random, count, chosen);
        const Result<Model> model = make(chosen);
        if (!model) continue;
        std::ptrdiff_t agreeing = 0;
        for (std::ptrdiff_t i = 0; i < count; ++i) {
            // What can no longer win is left.
            if (any && agreeing + (count - i) <= best.agreeing) break;
            if (agrees(*model, i)) ++agreeing;
        }
        if (any && agreeing <= best.agreeing) continue;
        any = true;
        best.model = *model;
        best.agreeing = agreeing;
        needed = ransac_samples(agreeing, count, SampleSize, options.miss_bits, options.most_samples);
    }
    if (!any) return Status::degenerate;
    if (best.agreeing < enough) return Status::not_found;
    best.samples = drawn;
    best.certain = needed < options.most_samples ||
                   ransac_samples(best.agreeing, count, SampleSize, options.miss_bits, 1 << 20) <= drawn;
    return best;
}

}  // namespace fovea
