// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/code/read_blurred_bars.hpp>

#include "support/blurred_bars.hpp"

namespace fovea {
namespace {

struct Scene {
    Size size{300, 240};
    std::vector<Gray8> pixels = std::vector<Gray8>(300 * 240, 200);
    ImageView<const Gray8> view() const { return {pixels.data(), size, size.width}; }
};

/// Bars around the middle of a picture, 90 px high, reading in a direction, with the blur of their camera.
Scene scene(const std::string& digits, double degrees, const test::BarCamera& camera) {
    Scene result;
    const std::vector<std::uint16_t> profile = test::bar_profile(test::ean_modules(digits), camera);
    const double angle = degrees * std::acos(-1.0) / 180;
    const double middle = static_cast<double>(profile.size()) / 2;
    for (int y = 0; y < result.size.height; ++y) {
        for (int x = 0; x < result.size.width; ++x) {
            const double dx = x - result.size.width / 2.0;
            const double dy = y - result.size.height / 2.0;
            const double along = middle + dx * std::cos(angle) + dy * std::sin(angle);
            const double across = dy * std::cos(angle) - dx * std::sin(angle);
            if (along < 0 || along >= static_cast<double>(profile.size()) - 1 || std::fabs(across) > 45)
                continue;
            const auto at = static_cast<std::size_t>(along);
            const double part = along - static_cast<double>(at);
            const double level = (profile[at] * (1 - part) + profile[at + 1] * part) / 256;
            result.pixels[static_cast<std::size_t>(y * result.size.width + x)] = static_cast<Gray8>(level);
        }
    }
    return result;
}

struct Read {
    Status status = Status::ok;
    std::vector<Code> codes;
    std::string text;
};
Read read(const Scene& scene, SymbologySet symbologies, int most = 4) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_blurred_bars_scratch(scene.size)));
    std::uint8_t room[64] = {};
    CodeText text({room, 64});
    List<Code, 4> codes;
    Read result;
    result.status =
        read_blurred_bars(scene.view(), symbologies, most,
                          {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text, codes.view());
    result.codes.assign(codes.begin(), codes.end());
    result.text.assign(room, room + text.size());
    return result;
}

test::BarCamera blurred() {
    test::BarCamera camera;
    camera.module = 1.8;
    camera.blur = 4;
    camera.margin = 25;
    return camera;
}

TEST(ReadBlurredBars, ReadsAtAnyAngleAndTellsWhereReadingBegins) {
    for (int degrees = 0; degrees < 360; degrees += 20) {
        const Read result = read(scene("9780905705712", degrees, blurred()), Symbology::ean_13);
        ASSERT_EQ(result.status, Status::ok) << degrees;
        ASSERT_EQ(result.codes.size(), 1U) << degrees;
        EXPECT_EQ(result.text, "9780905705712");
        const Code& code = result.codes[0];
        EXPECT_EQ(code.symbology, Symbology::ean_13);
        EXPECT_GE(code.agreeing_lines, 2);
        // From its first bar to its last one: 171 px in the direction of reading.
        const double angle = degrees * std::acos(-1.0) / 180;
        const double dx = (code.corners[1].x.raw() - code.corners[0].x.raw()) / 256.0;
        const double dy = (code.corners[1].y.raw() - code.corners[0].y.raw()) / 256.0;
        EXPECT_NEAR(dx, 171 * std::cos(angle), 6) << degrees;
        EXPECT_NEAR(dy, 171 * std::sin(angle), 6) << degrees;
        // Clockwise as one reads: the last corner lies below the first.
        const double down_x = (code.corners[3].x.raw() - code.corners[0].x.raw()) / 256.0;
        const double down_y = (code.corners[3].y.raw() - code.corners[0].y.raw()) / 256.0;
        EXPECT_GT(down_y * std::cos(angle) - down_x * std::sin(angle), 0) << degrees;
    }
}

TEST(ReadBlurredBars, CallsAnEanThatBeginsWithZeroAsIsAskedFor) {
    const Scene picture = scene("0036000291452", 0, blurred());
    Read result = read(picture, SymbologySet(Symbology::ean_13) | Symbology::upc_a);
    ASSERT_EQ(result.codes.size(), 1U);
    EXPECT_EQ(result.codes[0].symbology, Symbology::upc_a);
    EXPECT_EQ(result.text, "036000291452");
    result = read(picture, Symbology::ean_13);
    ASSERT_EQ(result.codes.size(), 1U);
    EXPECT_EQ(result.text, "0036000291452");
    EXPECT_EQ(read(scene("9780905705712", 0, blurred()), Symbology::upc_a).status, Status::not_found);
}

TEST(ReadBlurredBars, ReadsEan8WhereItIsAskedFor) {
    test::BarCamera camera = blurred();
    camera.module = 2.4;
    camera.margin = 30;
    const Scene picture = scene("96385074", 0, camera);
    const Read result = read(picture, Symbology::ean_8);
    ASSERT_EQ(result.codes.size(), 1U);
    EXPECT_EQ(result.text, "96385074");
    EXPECT_EQ(result.codes[0].aim_digit, '4');
    EXPECT_EQ(read(picture, Symbology::qr).status, Status::not_found);
}

// A small label with an EAN-13 over the middle guard of a large EAN-8. The whole is read first, as an EAN-8
// with a margin of 1.43, which is not clear; that of the label is 1.29, which is.
TEST(ReadBlurredBars, AClearEan13IsNotHiddenByAnEan8ThatIsNot) {
    test::BarCamera large, small;
    large.module = 10.2;
    large.blur = 26.5;
    large.margin = 40;
    large.dark = 0.79;
    small.module = 1.33;
    small.blur = 5.3;
    small.margin = 7;
    small.dark = 0.52;
    std::vector<std::uint16_t> profile = test::bar_profile(test::ean_modules("36062171"), large);
    const std::vector<std::uint16_t> label = test::bar_profile(test::ean_modules("0151776141678"), small);
    std::copy(label.begin(), label.end(),
              profile.begin() + static_cast<std::ptrdiff_t>((profile.size() - label.size()) / 2));
    const auto size = static_cast<int>(profile.size());
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_blurred_bars_scratch({size, 1})));
    const std::vector<Gray8> pixels(profile.size(), 200);
    const auto best_of = [&](SymbologySet symbologies) {
        detail::BlurredSearch search({pixels.data(), {size, 1}, size}, symbologies,
                                     {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())});
        BlurredEan best;
        EXPECT_TRUE(search.read_profile({profile.data(), size}, size / 2, best));
        return best;
    };
    const BlurredEan ean_8 = best_of(Symbology::ean_8), ean_13 = best_of(Symbology::ean_13);
    ASSERT_FALSE(detail::is_clear_reading(ean_8));
    ASSERT_TRUE(detail::is_clear_reading(ean_13));
    ASSERT_GT(ean_8.margin, ean_13.margin);
    const BlurredEan both = best_of(SymbologySet(Symbology::ean_8) | Symbology::ean_13);
    EXPECT_EQ(both.symbology, Symbology::ean_13);
    EXPECT_EQ(std::vector<int>(both.digits, both.digits + both.digit_count),
              (std::vector<int>{0, 1, 5, 1, 7, 7, 6, 1, 4, 1, 6, 7, 8}));
}

TEST(ReadBlurredBars, SaysWhatIsWrong) {
    const Scene picture = scene("9780905705712", 0, blurred());
    EXPECT_EQ(read(Scene(), SymbologySet::all()).status, Status::not_found);
    EXPECT_EQ(read(picture, Symbology::ean_13, 0).status, Status::bad_argument);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_blurred_bars_scratch(picture.size)));
    const Span<std::uint8_t> memory(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::uint8_t room[13] = {};
    CodeText text({room, 13});
    CodeText small({room, 12});
    List<Code, 1> codes;
    EXPECT_EQ(read_blurred_bars({}, Symbology::ean_13, 1, memory, text, codes.view()), Status::empty_image);
    EXPECT_EQ(read_blurred_bars(picture.view(), Symbology::ean_13, 1, memory.first(memory.size() - 1), text,
                                codes.view()),
              Status::scratch_too_small);
    EXPECT_EQ(read_blurred_bars(picture.view(), Symbology::ean_13, 1, memory, small, codes.view()),
              Status::buffer_too_small);
    EXPECT_EQ(small.size(), 0);
    int none = 0;
    EXPECT_EQ(read_blurred_bars(picture.view(), Symbology::ean_13, 1, memory, text,
                                ListView<Code>(nullptr, 0, &none)),
              Status::capacity_exceeded);
    EXPECT_EQ(text.size(), 0);
}

}  // namespace
}  // namespace fovea
