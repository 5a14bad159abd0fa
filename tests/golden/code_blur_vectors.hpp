// SPDX-License-Identifier: MIT
//
// Golden vectors of the codes out of focus in code/.
#pragma once

#include <cstdint>

#include <fovea/base/arena.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/random.hpp>
#include <fovea/code/blurred_ean.hpp>
#include <fovea/code/blurred_votes.hpp>
#include <fovea/code/profile_spans.hpp>
#include <fovea/code/read_blurred_bars.hpp>
#include <golden/code_qr_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, const BlurredEan& ean) {
    digest.add(ean.symbology, ean.digit_count, ean.reversed, ean.start, ean.end, ean.blur, ean.residual,
               ean.margin);
    for (int i = 0; i < ean.digit_count; ++i) digest.add(ean.digits[i]);
}

/// The profile of digits with modules of two pixels under uneven light, in at most 240 places.
inline Span<const std::uint16_t> blurred_profile(const detail::BlurPlan& plan, Ratio blur, Random& random,
                                                 Span<std::int32_t> darkness, Span<std::uint16_t> profile) {
    constexpr int margin = 12;
    std::uint8_t digits[13] = {};
    int sum = 0;
    for (int i = plan.has_parity ? 0 : 1; i < plan.letters; ++i) {
        digits[i] = static_cast<std::uint8_t>(random.below(10));
        sum += digits[i] * (i % 2 == 1 ? 3 : 1);
    }
    digits[plan.letters] = static_cast<std::uint8_t>((10 - sum % 10) % 10);
    std::uint8_t row[detail::most_blur_letters] = {};
    for (int i = 0; i < plan.letters; ++i)
        row[i] = static_cast<std::uint8_t>(detail::letter_of(plan, digits, i));
    detail::darkness_of_letters(plan, detail::module_response(blur), row, darkness.data());
    const int size = plan.samples() + 2 * margin;
    for (int x = 0; x < size; ++x) {
        const bool inside = x >= margin && x < size - margin;
        const std::int32_t white = 50000 + 20 * x;
        profile[x] = static_cast<std::uint16_t>(white - (inside ? 30 * darkness[x - margin] : 0) +
                                                static_cast<std::int32_t>(random.below(128)));
    }
    return profile.first(size);
}

inline void code_blurred_ean(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span());
    BlurredEanScratch& scratch = arena.take_unset<BlurredEanScratch>(1)[0];
    const Span<std::int32_t> darkness = arena.take_unset<std::int32_t>(detail::most_blur_samples);
    const Span<std::uint16_t> memory = arena.take_unset<std::uint16_t>(240);
    Random random(17);
    BlurredVotes votes;
    for (int i = 0; i < 2; ++i) {
        const bool of_13 = i == 0;
        const Span<const std::uint16_t> profile =
            blurred_profile(of_13 ? detail::ean_13_plan : detail::ean_8_plan,
                            Ratio::from_ratio(i == 0 ? 23 : 12, 10), random, darkness, memory);
        List<ProfileSpan, 6> spans;
        digest.add(find_profile_spans(profile, static_cast<int>(profile.size() / 2), spans.view()));
        for (const ProfileSpan& span : spans) digest.add(span.left, span.right);
        const Result<BlurredEan> ean =
            read_blurred_ean(profile, {6, static_cast<int>(profile.size()) - 7},
                             of_13 ? Symbology::ean_13 : Symbology::ean_8, scratch);
        digest.add(ean.status());
        if (!ean.ok()) continue;
        digest.add(*ean, votes.take(*ean));
        digest.add(votes.decided(), votes.votes(), votes.best());
    }
    digest.add(read_blurred_ean({}, {}, Symbology::ean_13, scratch).status());
}

/// An EAN-13 with modules of a pixel, which blur makes run together.
inline void code_read_blurred_bars(Workspace& work, Digest& digest) {
    const ImageView<Gray8> image = work.view<Gray8>(0, Workspace::picture_size);
    Arena arena(work.scratch_span());
    const Span<std::int32_t> darkness = arena.take_unset<std::int32_t>(detail::most_blur_samples);
    const Span<std::uint16_t> memory = arena.take_unset<std::uint16_t>(240);
    Random random(29);
    const Span<const std::uint16_t> profile =
        blurred_profile(detail::ean_13_plan, Ratio::from_ratio(19, 10), random, darkness, memory);
    for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
            const int at = clamp(2 * x + y / 16, 0, static_cast<int>(profile.size()) - 2);
            const bool bars = y >= 8 && y < image.height() - 8;
            image(x, y) = static_cast<Gray8>((bars ? profile[at] + profile[at + 1] : 2 * 50000) >> 9);
        }
    }
    std::uint8_t room[32] = {};
    CodeText text({room, 32});
    List<Code, 2> codes;
    digest.add(read_blurred_bars(image, Symbology::ean_13, 1, work.scratch_span(), text, codes), text);
    for (const Code& code : codes) digest.add(code);
    digest.add(read_blurred_bars_scratch({640, 480}), codes.size());
}

}  // namespace fovea::golden
