// SPDX-License-Identifier: MIT
//
// How a profile across bars came about: where the bars lie in it, how they are blurred, and in which light.
// Book ch. 5.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/code/blur_letters.hpp>
#include <fovea/code/blur_paths.hpp>
#include <fovea/code/ean_tables.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/integer.hpp>

namespace fovea::detail {

/// White and the step from it to black, at a quarter and at three quarters of the bars; between and beyond,
/// on the line through both. 1/256 gray level.
struct BlurLight {
    std::int32_t white[2];
    std::int32_t dark[2];

    friend constexpr bool operator==(const BlurLight& a, const BlurLight& b) {
        return a.white[0] == b.white[0] && a.white[1] == b.white[1] && a.dark[0] == b.dark[0] &&
               a.dark[1] == b.dark[1];
    }
};
/// Below 12 gray levels between white and black there is nothing to read.
inline constexpr std::int32_t least_blur_contrast = 12 * 256;

/// Places in 1/65536 px of the profile; start is right of end in what is read backwards.
struct BlurScene {
    std::int32_t start;  ///< the outer edge of the first bar
    std::int32_t end;    ///< the outer edge of the last bar
    std::int32_t
        bend;  ///< perspective: bars in the middle lie this share of the length before where they would; Ratio * 4
    std::int32_t blur;  ///< half of the width that an edge is spread over
    BlurLight light;
};

constexpr std::int32_t length_of(const BlurScene& scene) {
    return scene.end > scene.start ? scene.end - scene.start : scene.start - scene.end;
}
constexpr std::int32_t module_of(const BlurPlan& plan, const BlurScene& scene) {
    return length_of(scene) / plan.modules;
}
constexpr Ratio blur_in_modules(const BlurPlan& plan, const BlurScene& scene) {
    const std::int64_t modules =
        std::int64_t{scene.blur} * plan.modules * Ratio::one / maximum<std::int32_t>(length_of(scene), 1);
    return Ratio::from_raw(
        static_cast<std::int32_t>(clamp<std::int64_t>(modules, Ratio::one * 3 / 10, Ratio::one * 7 / 2)));
}

/// Where the samples of a plan lie between the ends of its bars, and how far perspective moves them there;
/// both Ratio.
struct BlurPlaces {
    std::int32_t share[most_blur_samples];
    std::int32_t bend[most_blur_samples];
};
constexpr BlurPlaces places_of(const BlurPlan& plan) {
    BlurPlaces places{};
    for (int j = 0; j < plan.samples(); ++j) {
        const std::int64_t share =
            std::int64_t{2 * (j - blur_reach) + 1} * Ratio::one / (2 * blur_samples * plan.modules);
        places.share[j] = static_cast<std::int32_t>(share);
        places.bend[j] = static_cast<std::int32_t>(share * (share - Ratio::one) >> 16);
    }
    return places;
}
inline constexpr BlurPlaces ean_13_places = places_of(ean_13_plan);
inline constexpr BlurPlaces ean_8_places = places_of(ean_8_plan);

/// The levels of a profile at two places a module, linear between its own; beyond its ends, its last.
inline void sample_profile(const BlurPlan& plan, Span<const std::uint16_t> profile, const BlurScene& scene,
                           std::int32_t* levels) {
    const BlurPlaces& places = plan.has_parity ? ean_13_places : ean_8_places;
    const std::int64_t length = std::int64_t{scene.end} - scene.start;
    const std::int64_t most = (profile.size() - 1) * std::int64_t{FinePixel::one} - 1;
    for (int j = 0; j < plan.samples(); ++j) {
        const std::int64_t bent = places.share[j] + (std::int64_t{scene.bend} * places.bend[j] >> 16);
        const std::int64_t place = clamp<std::int64_t>(scene.start + (length * bent >> 16), 0, most);
        const auto x = static_cast<std::ptrdiff_t>(place >> 16);
        const auto part = static_cast<std::int32_t>(place & 0xFFFF) >> 4;
        levels[j] = profile[x] + ((profile[x + 1] - profile[x]) * part >> 12);
    }
}

/// White and dark at a sample. Dark stays above a gray level, so that it divides.
struct LightAt {
    std::int32_t white;
    std::int32_t dark;
};
/// Bounds  levels of light are below 2^19 and places below 2^9: 32 bits hold their product
inline LightAt light_at(const BlurPlan& plan, const BlurLight& light, int sample) {
    // In quarters of a module, half of a symbol is 2 * modules of them.
    const int place = 2 * (sample - blur_reach) + 1 - plan.modules;
    const auto line = [&](const std::int32_t(&level)[2]) {
        return level[0] + (level[1] - level[0]) * place / (2 * plan.modules);
    };
    return {line(light.white), maximum<std::int32_t>(line(light.dark), 256)};
}

/// What darkness_of() needs of a light at every sample: made once for all scenes in the same light.
struct BlurLightTable {
    BlurLight light;
    int samples = 0;  ///< of its plan; 0: not made
    LightAt at[most_blur_samples];
    std::uint64_t
        reciprocal[most_blur_samples];  ///< of dark, 2^light_reciprocal_bits * full_darkness / dark, upwards
};
/// Enough for an exact quotient: with n <= 2 * dark below 2^20, 2^40 is above n times what the reciprocal is
/// too much, which is below dark.
inline constexpr int light_reciprocal_bits = 40;

inline void make_light_table(const BlurPlan& plan, const BlurLight& light, BlurLightTable& table) {
    table.light = light;
    table.samples = plan.samples();
    constexpr std::uint64_t one = std::uint64_t{full_darkness} << light_reciprocal_bits;
    for (int j = 0; j < plan.samples(); ++j) {
        table.at[j] = light_at(plan, light, j);
        const auto dark = static_cast<std::uint64_t>(table.at[j].dark);
        FOVEA_ASSERT(dark < (1U << 19));
        table.reciprocal[j] = (one + dark - 1) / dark;
    }
}

/// Levels as darkness: 0 white, full_darkness black, and as much more to both sides as cost_letters() bears;
/// quotients toward 0.
inline void darkness_of(const BlurPlan& plan, const std::int32_t* levels, const BlurLightTable& table,
                        std::int32_t* darkness) {
    for (int j = 0; j < plan.samples(); ++j) {
        const LightAt at = table.at[j];
        // Within what full_darkness times it over dark is from -full_darkness to 2 * full_darkness.
        const std::int32_t off = clamp<std::int32_t>(at.white - levels[j], -at.dark, 2 * at.dark);
        const auto size = static_cast<std::uint64_t>(off < 0 ? -off : off);
        const auto quotient = static_cast<std::int32_t>(size * table.reciprocal[j] >> light_reciprocal_bits);
        darkness[j] = off < 0 ? -quotient : quotient;
    }
}
inline void take_guards(const BlurPlan& plan, const ModuleResponse& module, std::int32_t* darkness) {
    for (int guard = 0; guard < BlurPlan::guards; ++guard) {
        std::int32_t* at = darkness + blur_samples * plan.guard(guard);
        for (int i = 0; i < module_response_size; ++i) at[i] -= module.at[i];
    }
}

/// The darkness that a row of letters with its guards would show.
inline void darkness_of_letters(const BlurPlan& plan, const ModuleResponse& module, const std::uint8_t* row,
                                std::int32_t* darkness) {
    for (int j = 0; j < plan.samples(); ++j) darkness[j] = 0;
    const auto add = [&](int dark) {
        std::int32_t* at = darkness + blur_samples * dark;
        for (int i = 0; i < module_response_size; ++i) at[i] += module.at[i];
    };
    for (int guard = 0; guard < BlurPlan::guards; ++guard) add(plan.guard(guard));
    for (int place = 0; place < plan.letters; ++place) {
        const unsigned modules = letter_modules(row[place]);
        for (int k = 0; k < 7; ++k) {
            if ((modules >> (6 - k) & 1) != 0) add(plan.first(place) + k);
        }
    }
}
/// The letter at a place of digits that begin with the one that parity tells.
constexpr int letter_of(const BlurPlan& plan, const std::uint8_t* digits, int place) {
    const int digit = digits[place + 1];
    if (place >= plan.left) return first_c + digit;
    const bool of_b = plan.has_parity && (ean_13_parity[digits[0]] >> (plan.left - 1 - place) & 1) != 0;
    return of_b ? 10 + digit : digit;
}

/// The light in which levels come closest to a darkness, by least squares in each half; false where levels
/// rise with it.
inline bool fit_light(const BlurPlan& plan, const std::int32_t* levels, const std::int32_t* darkness,
                      BlurLight& light) {
    BlurLight fitted{};
    const int half = plan.samples() / 2;
    for (int side = 0; side < 2; ++side) {
        std::int64_t sum_d = 0;
        std::int64_t sum_y = 0;
        std::int64_t sum_dd = 0;
        std::int64_t sum_dy = 0;
        for (int j = side * half; j < (side + 1) * half; ++j) {
            sum_d += darkness[j];
            sum_y += levels[j];
            sum_dd += std::int64_t{darkness[j]} * darkness[j];
            sum_dy += std::int64_t{darkness[j]} * levels[j];
        }
        const std::int64_t spread = half * sum_dd - sum_d * sum_d;
        const std::int64_t falls = sum_d * sum_y - half * sum_dy;
        if (spread <= 0 || falls <= 0) return false;
        const std::int64_t dark = falls * full_darkness / spread;
        if (dark < least_blur_contrast || dark > 4 * 65536) return false;
        fitted.dark[side] = static_cast<std::int32_t>(dark);
        fitted.white[side] = static_cast<std::int32_t>((sum_y + sum_d * dark / full_darkness) / half);
    }
    light = fitted;
    return true;
}

/// Darkness at the outer edge of a symbol: of the bar, space and bar of its guard, of the space that follows,
/// and of the unknown behind it, which is dark by half.
inline std::int32_t guard_edge(const ModuleResponse& module) {
    const auto at_edge = [&](int k) {
        // The edge of module 0 lies between two samples of each module's response.
        const int after = blur_reach - blur_samples * k;
        return after < 1 ? 0 : (module.at[after - 1] + module.at[after]) / 2;
    };
    return at_edge(0) + at_edge(2) + at_edge(4) / 2;
}

/// Where a profile falls below a level first, from a place in steps of 1 or -1, for at most 64 of them;
/// negative: nowhere.
inline std::int32_t falls_to(Span<const std::uint16_t> profile, int from, int step, std::int32_t level) {
    for (int x = from, steps = 0; steps < 64; x += step, ++steps) {
        if (x < 0 || x >= profile.size() || x + step < 0 || x + step >= profile.size()) return -1;
        const std::int32_t here = profile[x];
        const std::int32_t next = profile[x + step];
        if (here < level || next >= level) continue;
        return x * FinePixel::one +
               step * static_cast<std::int32_t>((std::int64_t{here - level} << 16) / (here - next));
    }
    return -1;
}

/// Fits place, perspective, blur and light of a scene to letters that are known, one after the other in ever
/// smaller steps.
class SceneFit {
public:
    SceneFit(const BlurPlan& plan, Span<const std::uint16_t> profile, const std::uint8_t* row,
             std::int32_t* levels, std::int32_t* darkness)
        : plan_(plan), profile_(profile), row_(row), levels_(levels), darkness_(darkness) {}

    /// What the scene leaves unexplained then: a sum of squares of darkness.
    std::int64_t improve(BlurScene& scene) {
        std::int64_t least = unexplained(scene);
        const std::int32_t module = module_of(plan_, scene);
        std::int32_t steps[4] = {module / 4, module / 4, Ratio::one / 64, module / 4};
        for (int size = 0; size < 4; ++size) {
            for (int turn = 0; turn < 3; ++turn) {
                if (!move_each(scene, steps, least)) break;
            }
            for (std::int32_t& step : steps) step /= 2;
        }
        return least;
    }

private:
    bool move_each(BlurScene& scene, const std::int32_t (&steps)[4], std::int64_t& least) {
        bool moved = false;
        for (int which = 0; which < 4; ++which) {
            for (const int sign : {-1, 1}) {
                BlurScene other = scene;
                std::int32_t* const value[4] = {&other.start, &other.end, &other.bend, &other.blur};
                *value[which] += sign * steps[which];
                const std::int64_t left = unexplained(other);
                if (left >= least) continue;
                least = left;
                scene = other;
                moved = true;
                break;
            }
        }
        return moved;
    }
    std::int64_t unexplained(BlurScene& scene) {
        sample_profile(plan_, profile_, scene, levels_);
        darkness_of_letters(plan_, module_response(blur_in_modules(plan_, scene)), row_, darkness_);
        if (!fit_light(plan_, levels_, darkness_, scene.light))
            return std::numeric_limits<std::int64_t>::max();
        std::int64_t sum = 0;
        for (int j = 0; j < plan_.samples(); ++j) {
            const LightAt at = light_at(plan_, scene.light, j);
            const std::int64_t off =
                std::int64_t{at.white - levels_[j]} * full_darkness / at.dark - darkness_[j];
            sum += off * off;
        }
        return sum;
    }

    const BlurPlan& plan_;
    Span<const std::uint16_t> profile_;
    const std::uint8_t* row_;
    std::int32_t* levels_;
    std::int32_t* darkness_;
};

}  // namespace fovea::detail
