// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <fovea/code/blurred_ean.hpp>

#include "support/blurred_bars.hpp"

namespace fovea {
namespace {

BlurredEanScratch& scratch() {
    static BlurredEanScratch memory;
    return memory;
}
Span<const std::uint16_t> view(const std::vector<std::uint16_t>& profile) {
    return {profile.data(), static_cast<std::ptrdiff_t>(profile.size())};
}
ProfileSpan span_of(const std::vector<std::uint16_t>& profile, const test::BarCamera& camera) {
    const int before = static_cast<int>(camera.margin - camera.blur) - 1;
    return {before, static_cast<int>(profile.size()) - 1 - before};
}
std::string text(const BlurredEan& ean) {
    std::string digits;
    for (int i = 0; i < ean.digit_count; ++i) digits += static_cast<char>('0' + ean.digits[i]);
    return digits;
}

TEST(ReadBlurredEan, ReadsTheBooksOwnNumberWhereItsBarsRunTogether) {
    test::BarCamera camera;
    camera.module = 1.6;
    camera.blur = 4;  // two and a half modules to each side: no bar has edges of its own
    camera.noise = 0.5;
    const std::vector<std::uint16_t> profile = test::bar_profile(test::ean_modules("9780905705712"), camera);
    const Result<BlurredEan> ean =
        read_blurred_ean(view(profile), span_of(profile, camera), Symbology::ean_13, scratch());
    ASSERT_TRUE(ean.ok());
    EXPECT_EQ(text(*ean), "9780905705712");
    EXPECT_GT(ean->margin.raw(), Ratio::one * 2);
    EXPECT_LT(ean->residual.raw(), Ratio::one * 3 / 100);
    EXPECT_FALSE(ean->reversed);
    EXPECT_NEAR(ean->start.raw() / 65536.0, 20, 0.3);
    EXPECT_NEAR(ean->end.raw() / 65536.0, 20 + 152, 0.3);
    EXPECT_NEAR(ean->blur.raw() / 65536.0, 4, 0.4);
}

TEST(ReadBlurredEan, ReadsBothWaysAndAtAnySizeAndBlur) {
    std::mt19937 random(23);
    int read = 0;
    int tried = 0;
    for (const Symbology symbology : {Symbology::ean_13, Symbology::ean_8}) {
        for (int i = 0; i < 36; ++i) {
            test::BarCamera camera;
            camera.module = 1.3 + 0.15 * (i % 9);
            camera.blur = camera.module * (1.1 + 0.4 * (i % 5));
            camera.margin = 9 * camera.module;
            camera.bend = 0.01 * (i % 5 - 2);
            camera.white_right = 150 + 20 * (i % 4);
            camera.noise = 0.5;
            camera.seed = static_cast<unsigned>(i);
            const std::string digits =
                test::with_check_digit(test::random_digits(random, symbology == Symbology::ean_13 ? 12 : 7));
            std::vector<std::uint16_t> profile = test::bar_profile(test::ean_modules(digits), camera);
            const bool reversed = i % 2 != 0;
            if (reversed) std::reverse(profile.begin(), profile.end());
            const Result<BlurredEan> ean =
                read_blurred_ean(view(profile), span_of(profile, camera), symbology, scratch());
            ++tried;
            if (!ean.ok() || ean->margin.raw() < Ratio::one * 5 / 4) continue;
            EXPECT_EQ(text(*ean), digits) << i;
            EXPECT_EQ(ean->reversed, reversed);
            EXPECT_EQ(ean->symbology, symbology);
            ++read;
        }
    }
    // Of the strongest blur under the strongest bend not all are read; nothing is misread.
    EXPECT_GE(read, tried * 9 / 10);
}

TEST(ReadBlurredEan, HasNoMarginWhereThereIsNoEan) {
    std::mt19937 random(5);
    int seen = 0;
    for (int i = 0; i < 300; ++i) {
        // Bars of random widths that are no letters.
        std::string modules = "101";
        while (modules.size() < 92) {
            modules += std::string(1 + random() % 4, random() % 2 == 0 ? '0' : '1');
        }
        modules += "101";
        test::BarCamera camera;
        camera.module = 1.5 + 0.1 * (i % 10);
        camera.blur = camera.module * (0.8 + 0.4 * (i % 6));
        camera.margin = 9 * camera.module;
        const std::vector<std::uint16_t> profile = test::bar_profile(modules, camera);
        const Result<BlurredEan> ean =
            read_blurred_ean(view(profile), span_of(profile, camera),
                             i % 3 == 0 ? Symbology::ean_8 : Symbology::ean_13, scratch());
        if (!ean.ok()) continue;
        ++seen;
        EXPECT_LT(ean->margin.raw(), Ratio::one * 5 / 4) << i << ' ' << text(*ean);
    }
    RecordProperty("looked_like_one", seen);
}

TEST(ReadBlurredEan, SaysWhatItCannotRead) {
    const std::vector<std::uint16_t> flat(200, 40000);
    EXPECT_EQ(read_blurred_ean({}, {2, 100}, Symbology::ean_13, scratch()).status(), Status::empty_image);
    EXPECT_EQ(read_blurred_ean(view(flat), {2, 197}, Symbology::ean_13, scratch()).status(),
              Status::not_found);
    EXPECT_EQ(read_blurred_ean(view(flat), {1, 190}, Symbology::ean_13, scratch()).status(),
              Status::bad_argument);
    EXPECT_EQ(read_blurred_ean(view(flat), {2, 198}, Symbology::ean_13, scratch()).status(),
              Status::bad_argument);
    EXPECT_EQ(read_blurred_ean(view(flat), {100, 20}, Symbology::ean_13, scratch()).status(),
              Status::bad_argument);
    EXPECT_EQ(read_blurred_ean(view(flat), {2, 190}, Symbology::qr, scratch()).status(),
              Status::bad_argument);
    const std::vector<std::uint16_t> tiny(63, 40000);
    EXPECT_EQ(read_blurred_ean(view(tiny), {2, 60}, Symbology::ean_13, scratch()).status(),
              Status::bad_argument);
}

TEST(ReadBlurredEan, TakesAnyProfile) {
    std::mt19937 random(99);
    for (int i = 0; i < 200; ++i) {
        std::vector<std::uint16_t> profile(64 + random() % 300);
        const unsigned kind = random() % 4;
        for (std::size_t x = 0; x < profile.size(); ++x) {
            profile[x] = kind == 0   ? static_cast<std::uint16_t>(random())
                         : kind == 1 ? (x / static_cast<std::size_t>(1 + i % 7) % 2 == 0 ? 65535 : 0)
                         : kind == 2 ? static_cast<std::uint16_t>(x * 211)
                                     : 65535;
        }
        const int right = static_cast<int>(profile.size()) - 3;
        const Result<BlurredEan> ean =
            read_blurred_ean(view(profile), {2, right}, Symbology::ean_13, scratch());
        if (ean.ok()) {
            EXPECT_LT(ean->margin.raw(), Ratio::one * 5 / 4);
        }
    }
}

}  // namespace
}  // namespace fovea
