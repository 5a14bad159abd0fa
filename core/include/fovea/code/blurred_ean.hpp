// SPDX-License-Identifier: MIT
//
// EAN and UPC out of focus: read by what a blurred row of letters would look like, where no edge of a bar is
// left to see. Book ch. 5; ISO/IEC 15420.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <limits>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/blur_letters.hpp>
#include <fovea/code/blur_paths.hpp>
#include <fovea/code/blur_scene.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/number/fixed.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// A stretch of a profile with bars between two light margins.
struct ProfileSpan {
    int left = 0;   ///< the last place that is surely of the left margin
    int right = 0;  ///< the first one of the right margin
};

/// What is needed to read one profile: about 24 KB.
struct BlurredEanScratch {
    detail::BlurLetters letters;
    detail::LetterCosts costs;
    detail::LetterPaths letter_paths;
    detail::DigitPaths paths;
    detail::BlurLightTable lights[2];
    std::int32_t levels[detail::most_blur_samples];
    std::int32_t darkness[detail::most_blur_samples];
};

/// An EAN-13 (UPC-A is one that begins with 0) or EAN-8 that fits a profile best.
struct BlurredEan {
    Symbology symbology = Symbology::ean_13;
    std::uint8_t digits[13] = {};  ///< the digits, 0 to 9
    int digit_count = 0;
    bool reversed = false;  ///< the profile runs against its reading direction
    FinePixel start;        ///< where its first bar begins in the profile; right of end where it is reversed
    FinePixel end;          ///< where its last bar ends
    FinePixel blur;         ///< half of the width over which an edge is spread
    Ratio residual;         ///< what it does not explain: root of the mean square, in shares of the contrast
    Ratio margin;  ///< how many times as much the next best digits leave unexplained, in squares; at most 8
};

/// The digits whose blurred picture comes closest to a profile across bars.
///
/// A model is fitted, not edges: letters of seven modules, spread by the disc of a lens out of focus, under
/// light that changes evenly along the bars. Place, size, perspective and blur are found by descent, the
/// digits by dynamic programming over all there are whose parity and check digit are right. A reading is as
/// good as its margin: what is no EAN gives margins below 1.2, for of all numbers some always come close;
/// see BlurredVotes for what may be believed.
///
/// Shapes    profile of 64 to max_image_side places, 1 px apart; span inside it, with at least two places of
///           margin
/// Units     levels in 1/256 gray level, light margins; places in px
/// Rounding  of fixed point, the same everywhere: darkness 1/1024, places 1/65536 px
/// Scratch   one BlurredEanScratch, undefined afterwards
/// Errors    empty_image; bad_argument for a profile or span outside its bounds or another symbology than
///           EAN-13 and EAN-8; not_found where bars are below 1 px or above 12 px a module, have no contrast,
///           or are no EAN at first sight
/// Source    book ch. 5; ISO/IEC 15420, 4.2, 4.3, annex A
inline Result<BlurredEan> read_blurred_ean(Span<const std::uint16_t> profile, ProfileSpan span,
                                           Symbology symbology, BlurredEanScratch& scratch);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// A guess at the whole scene, and what it costs.
struct BlurTrial {
    BlurScene scene;
    std::int32_t cost = 0;
    std::uint8_t row[most_blur_letters] = {};
};

/// What a cost is of the most that samples could have: the mean square of darkness.
constexpr std::int32_t mean_square(const BlurPlan& plan, std::int32_t cost) { return cost / plan.samples(); }
/// At first sight a row of letters must explain all but 13 % of the contrast, after descent all but 7 %; true
/// ones were seen with 3 to 7 and with 2.5 to 5.
inline constexpr std::int32_t worth_a_descent = full_darkness * 13 / 100 * (full_darkness * 13 / 100);
inline constexpr std::int32_t worth_reading = full_darkness * 7 / 100 * (full_darkness * 7 / 100);

class BlurredEanReader {
public:
    BlurredEanReader(Span<const std::uint16_t> profile, const BlurPlan& plan, BlurredEanScratch& scratch)
        : profile_(profile), plan_(plan), scratch_(scratch) {
        for (BlurLightTable& table : scratch_.lights) table.samples = 0;
    }

    Status read(ProfileSpan span, BlurredEan& best) {
        BlurLight light;
        if (!estimate_light(span, light)) return Status::not_found;
        BlurTrial trials[kept_trials];
        int count = 0;
        for (const std::int32_t raw : first_blurs) {
            const Ratio blur = Ratio::from_raw(raw);
            see_letters(blur, scratch_.letters);
            for (const bool reversed : {false, true}) look(span, reversed, light, blur, trials, count);
        }
        BlurTrial* closest = nullptr;
        for (int i = 0; i < count; ++i) {
            if (mean_square(plan_, trials[i].cost) > worth_a_descent) continue;
            see_letters(blur_in_modules(plan_, trials[i].scene), scratch_.letters);
            descend(trials[i]);
            if (closest == nullptr || trials[i].cost < closest->cost) closest = &trials[i];
        }
        if (closest == nullptr || mean_square(plan_, closest->cost) > worth_reading) return Status::not_found;
        finish(*closest, best);
        return Status::ok;
    }

    /// Scenes that were looked at.
    int work() const { return work_; }

private:
    /// Guesses that are followed.
    static constexpr int kept_trials = 3;
    /// Half widths of blur in modules, Ratio: each is near enough to the next for the descent.
    static constexpr std::int32_t first_blurs[6] = {Ratio::one * 6 / 10,  Ratio::one,
                                                    Ratio::one * 15 / 10, Ratio::one * 2,
                                                    Ratio::one * 26 / 10, Ratio::one * 32 / 10};

    /// Perspective that moves the middle of the bars by half a module of EAN-13, which little blur does not
    /// forgive.
    static constexpr std::int32_t first_bend = Ratio::one / 50;

    /// White at both ends; contrast from the mean, for half of all modules are dark, more or less.
    bool estimate_light(ProfileSpan span, BlurLight& light) const {
        const std::int32_t left = profile_[span.left - 1];
        const std::int32_t right = profile_[span.right + 1];
        std::int64_t sum = 0;
        for (int x = span.left; x < span.right; ++x) sum += profile_[x];
        const auto mean = static_cast<std::int32_t>(sum / (span.right - span.left));
        light.dark[0] = light.dark[1] = left + right - 2 * mean;
        light.white[0] = left + (right - left) / 4;
        light.white[1] = right + (left - right) / 4;
        return light.dark[0] >= least_blur_contrast;
    }
    /// The first guesses at a blur: the ends where the outermost bar has the darkness that it would have
    /// there, in straight view and from both sides.
    void look(ProfileSpan span, bool reversed, const BlurLight& light, Ratio blur,
              BlurTrial (&trials)[kept_trials], int& count) {
        const std::int32_t edge = guard_edge(scratch_.letters.module);
        const std::int32_t left =
            falls_to(profile_, span.left - 2, 1, profile_[span.left - 1] - edge_level(light.dark[0], edge));
        const std::int32_t right = falls_to(profile_, span.right + 2, -1,
                                            profile_[span.right + 1] - edge_level(light.dark[1], edge));
        const std::int32_t length = right - left;
        if (left < 0 || right < 0 || length < plan_.modules * FinePixel::one) return;
        if (length > 12 * plan_.modules * std::int64_t{FinePixel::one}) return;
        BlurTrial trial;
        trial.scene = {reversed ? right : left, reversed ? left : right, 0, 0, light};
        if (reversed) trial.scene.light = {{light.white[1], light.white[0]}, {light.dark[1], light.dark[0]}};
        trial.scene.blur = static_cast<std::int32_t>(std::int64_t{blur.raw()} * length /
                                                     (plan_.modules * std::int64_t{Ratio::one}));
        BlurTrial best = trial;
        // What is not worth a descent, or than the worst that is kept, needs not be known any better.
        std::int32_t limit = (worth_a_descent + 1) * plan_.samples();
        if (count == kept_trials) limit = minimum(limit, trials[kept_trials - 1].cost);
        for (const int side : {0, -1, 1}) {
            trial.scene.bend = side * first_bend;
            evaluate(trial, limit);
            if (side == 0 || trial.cost < best.cost) best = trial;
        }
        keep_better(best, trials, count);
    }
    static std::int32_t edge_level(std::int32_t dark, std::int32_t edge) {
        return static_cast<std::int32_t>(std::int64_t{dark} * edge / full_darkness);
    }

    /// The cheapest letters of a scene, for the blur that the letters were made for. A cost above the limit
    /// may be told too low, but not below it.
    void evaluate(BlurTrial& trial, std::int32_t limit) {
        ++work_;
        sample_profile(plan_, profile_, trial.scene, scratch_.levels);
        darkness_of(plan_, scratch_.levels, light_table(trial.scene.light), scratch_.darkness);
        take_guards(plan_, scratch_.letters.module, scratch_.darkness);
        cost_letters(plan_, scratch_.letters, scratch_.darkness, scratch_.costs);
        trial.cost = least_letters(plan_, scratch_.costs);
        if (trial.cost > limit) return;
        trial.cost = cheapest_letters(plan_, scratch_.letters, scratch_.costs, scratch_.letter_paths);
    }
    /// Exactly, whatever it costs.
    void evaluate(BlurTrial& trial) { evaluate(trial, std::numeric_limits<std::int32_t>::max()); }

    /// Scenes of one profile are seen in few lights: one, the same from behind, and a fitted one.
    const BlurLightTable& light_table(const BlurLight& light) {
        for (const BlurLightTable& table : scratch_.lights) {
            if (table.samples != 0 && table.light == light) return table;
        }
        BlurLightTable& table = scratch_.lights[next_light_];
        next_light_ = 1 - next_light_;
        make_light_table(plan_, light, table);
        return table;
    }
    /// Both ends are moved by half a module, a quarter and an eighth, whatever makes letters fit; then the
    /// light to these.
    void descend(BlurTrial& trial) {
        std::int32_t step = module_of(plan_, trial.scene) / 2;
        for (int size = 0; size < 3; ++size, step /= 2) {
            for (int turn = 0; turn < 2; ++turn) {
                if (!move_ends(trial, step)) break;
            }
        }
        evaluate(trial);
        trace_letters(plan_, scratch_.letters, scratch_.letter_paths, trial.row);
        BlurTrial lit = trial;
        sample_profile(plan_, profile_, trial.scene, scratch_.levels);
        darkness_of_letters(plan_, scratch_.letters.module, trial.row, scratch_.darkness);
        if (!fit_light(plan_, scratch_.levels, scratch_.darkness, lit.scene.light)) return;
        evaluate(lit, trial.cost);
        if (lit.cost < trial.cost) trial = lit;
    }
    bool move_ends(BlurTrial& trial, std::int32_t step) {
        const BlurTrial from = trial;
        for (int start = -1; start <= 1; ++start) {
            for (int end = -1; end <= 1; ++end) {
                if (start == 0 && end == 0) continue;
                BlurTrial moved = from;
                moved.scene.start += start * step;
                moved.scene.end += end * step;
                evaluate(moved, trial.cost);
                if (moved.cost < trial.cost) trial = moved;
            }
        }
        return trial.cost < from.cost;
    }
    /// Keeps the cheapest, these in order.
    static void keep_better(const BlurTrial& trial, BlurTrial (&trials)[kept_trials], int& count) {
        int at = count;
        while (at > 0 && trial.cost < trials[at - 1].cost) --at;
        if (at == kept_trials) return;
        count = minimum(count + 1, kept_trials);
        for (int i = count - 1; i > at; --i) trials[i] = trials[i - 1];
        trials[at] = trial;
    }

    /// Digits and scene in turn, each by the other, until nothing gets better.
    void finish(BlurTrial& trial, BlurredEan& best) {
        std::int64_t last = std::numeric_limits<std::int64_t>::max();
        CheapestDigits found = digits_of(trial);
        for (int turn = 0; turn < 4; ++turn) {
            SceneFit fit(plan_, profile_, trial.row, scratch_.levels, scratch_.darkness);
            const std::int64_t unexplained = fit.improve(trial.scene);
            if (unexplained >= last) break;
            last = unexplained;
            found = digits_of(trial);
        }
        tell(trial, found, best);
    }
    CheapestDigits digits_of(BlurTrial& trial) {
        see_letters(blur_in_modules(plan_, trial.scene), scratch_.letters);
        evaluate(trial);
        const CheapestDigits found = cheapest_digits(plan_, scratch_.letters, scratch_.costs, scratch_.paths);
        for (int place = 0; place < plan_.letters; ++place) {
            trial.row[place] = static_cast<std::uint8_t>(letter_of(plan_, found.digits, place));
        }
        return found;
    }
    std::int32_t residual_of(std::int32_t cost) const {
        const std::int64_t square = (std::int64_t{maximum<std::int32_t>(cost, 0)} << 12) / plan_.samples();
        return static_cast<std::int32_t>(isqrt(static_cast<std::uint64_t>(square)));
    }
    void tell(const BlurTrial& trial, const CheapestDigits& found, BlurredEan& best) const {
        const int without = plan_.has_parity ? 0 : 1;
        best.symbology = plan_.has_parity ? Symbology::ean_13 : Symbology::ean_8;
        best.digit_count = plan_.letters + 1 - without;
        for (int i = 0; i < best.digit_count; ++i) best.digits[i] = found.digits[i + without];
        best.reversed = trial.scene.end < trial.scene.start;
        best.start = FinePixel::from_raw(trial.scene.start);
        best.end = FinePixel::from_raw(trial.scene.end);
        best.blur = FinePixel::from_raw(trial.scene.blur);
        best.residual = Ratio::from_raw(residual_of(found.cost));
        best.margin = Ratio::from_raw(static_cast<std::int32_t>(minimum<std::int64_t>(
            std::int64_t{found.second} * Ratio::one / maximum<std::int32_t>(found.cost, 1), 8 * Ratio::one)));
    }

    Span<const std::uint16_t> profile_;
    const BlurPlan& plan_;
    BlurredEanScratch& scratch_;
    int next_light_ = 0;
    int work_ = 0;
};

/// As read_blurred_ean(); adds to work the scenes that were looked at, of 64 samples each.
inline Result<BlurredEan> read_blurred_ean(Span<const std::uint16_t> profile, ProfileSpan span,
                                           Symbology symbology, BlurredEanScratch& scratch, int& work) {
    if (profile.empty()) return Status::empty_image;
    if (profile.size() < 64 || profile.size() > max_image_side) return Status::bad_argument;
    if (span.left < 2 || span.right > profile.size() - 3 || span.right - span.left < 64)
        return Status::bad_argument;
    if (symbology != Symbology::ean_13 && symbology != Symbology::ean_8) return Status::bad_argument;
    const BlurPlan& plan = symbology == Symbology::ean_13 ? ean_13_plan : ean_8_plan;
    BlurredEanReader reader(profile, plan, scratch);
    BlurredEan best;
    const Status status = reader.read(span, best);
    work += reader.work();
    if (status != Status::ok) return status;
    return best;
}

}  // namespace detail

inline Result<BlurredEan> read_blurred_ean(Span<const std::uint16_t> profile, ProfileSpan span,
                                           Symbology symbology, BlurredEanScratch& scratch) {
    int work = 0;
    return detail::read_blurred_ean(profile, span, symbology, scratch, work);
}

}  // namespace fovea
