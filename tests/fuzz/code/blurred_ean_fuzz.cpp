// SPDX-License-Identifier: MIT
//
// Any profile, and any stretch of it: what is read has digits, a right check digit and a place in the
// profile.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/code/blurred_ean.hpp>
#include <fovea/code/blurred_votes.hpp>
#include <fovea/code/profile_spans.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

void check(const BlurredEan& ean, Symbology symbology) {
    require(ean.symbology == symbology);
    require(ean.digit_count == (symbology == Symbology::ean_13 ? 13 : 8));
    int sum = 0;
    for (int i = 0; i < ean.digit_count; ++i) {
        require(ean.digits[i] <= 9);
        sum += ean.digits[i] * ((ean.digit_count - 1 - i) % 2 == 0 ? 1 : 3);
    }
    require(sum % 10 == 0);
    require(ean.margin.raw() >= Ratio::one && ean.residual.raw() >= 0);
    require(ean.reversed == (ean.end < ean.start) && ean.blur.raw() > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static BlurredEanScratch scratch;
    if (size < 8) return 0;
    // Levels from the input, drawn out by a factor and as rough or as smooth as a bit says.
    const std::size_t factor = 1U + data[0] % 6U;
    const bool smooth = (data[1] & 1) != 0;
    std::vector<std::uint16_t> profile;
    for (std::size_t i = 4; i + 1 < size && profile.size() < 400; ++i) {
        for (std::size_t k = 0; k < factor; ++k) {
            const std::size_t level =
                smooth ? (data[i] * (factor - k) + data[i + 1] * k) * 257 / factor : data[i] * 257U;
            profile.push_back(static_cast<std::uint16_t>(level));
        }
    }
    const Span<const std::uint16_t> view(profile.data(), static_cast<std::ptrdiff_t>(profile.size()));
    const Symbology symbology = (data[1] & 2) != 0 ? Symbology::ean_13 : Symbology::ean_8;
    BlurredVotes votes;
    const auto read = [&](ProfileSpan span) {
        const Result<BlurredEan> ean = read_blurred_ean(view, span, symbology, scratch);
        if (!ean.ok()) return;
        check(*ean, symbology);
        require(votes.take(*ean) >= 0);
    };
    read({data[2] - 8, data[3] * 4 - 8});
    List<ProfileSpan, 6> spans;
    if (find_profile_spans(view, static_cast<int>(profile.size() / 2), spans.view()) == Status::ok) {
        for (const ProfileSpan& span : spans) {
            require(span.left >= 2 && span.right < view.size() - 2 && span.right - span.left >= 64);
        }
        read(spans[data[3] % spans.size()]);
    }
    if (votes.decided()) check(votes.best(), symbology);
    return 0;
}
