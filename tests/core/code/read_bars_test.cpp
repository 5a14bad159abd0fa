// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <fovea/code/read_bars.hpp>
#include <support/bars.hpp>

namespace fovea::test {
namespace {

struct BarAnswer {
    Status status = Status::ok;
    std::string text;
    List<Code, 6> codes;
};
BarAnswer read(const BarPicture& picture, const ReadBarsOptions& options = {}, bool seen = false) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_bars_scratch(picture.size)));
    std::uint8_t room[400];
    CodeText text{Span<std::uint8_t>(room)};
    BarAnswer answer;
    answer.status =
        detail::read_bars(picture.view(), options, seen,
                          {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, text, answer.codes);
    answer.text.assign(room, room + text.size());
    return answer;
}
BarPicture picture_of(const BarSample& sample, const BarScene& scene, std::uint64_t seed = 3201) {
    Random random(seed);
    BarPicture picture({520, 400});
    draw_bars(picture, bars_of(sample.symbology, sample.text), scene, random);
    return picture;
}

TEST(ReadBars, ReadsEverySymbologyAtAnyAngle) {
    for (const BarSample& sample : bar_samples) {
        for (int degrees = 0; degrees < 360; degrees += 36) {
            BarScene scene;
            scene.degrees = degrees;
            scene.module = 1.6;
            const BarAnswer answer = read(picture_of(sample, scene));
            EXPECT_EQ(answer.status, Status::ok) << sample.text << " at " << degrees;
            EXPECT_EQ(answer.text, sample.text);
        }
    }
}

TEST(ReadBars, TellsTheCornersInTheOrderOfReading) {
    for (const int turn : {0, 180}) {
        BarScene scene;
        scene.degrees = turn;
        const BarAnswer answer = read(picture_of(bar_samples[0], scene));
        ASSERT_EQ(answer.codes.size(), 1);
        const Code& code = answer.codes[0];
        const int sign = turn == 0 ? 1 : -1;
        const double half = 95 * 2.5 / 2;
        EXPECT_NEAR(code.corners[0].x.raw() / 256.0, 259.5 - sign * half, 1.5);
        EXPECT_NEAR(code.corners[1].x.raw() / 256.0, 259.5 + sign * half, 1.5);
        EXPECT_NEAR(code.corners[2].x.raw() / 256.0, 259.5 + sign * half, 1.5);
        EXPECT_GE(sign * (code.corners[2].y.raw() - code.corners[1].y.raw()), 256);
        EXPECT_GE(code.agreeing_lines, 2);
        EXPECT_FALSE(code.mirrored);
    }
}

TEST(ReadBars, ReadsLightOnDark) {
    BarScene scene;
    scene.dark = 220;
    scene.light = 60;
    const BarAnswer answer = read(picture_of(bar_samples[0], scene));
    EXPECT_EQ(answer.text, bar_samples[0].text);
    EXPECT_TRUE(answer.codes[0].inverted);
}

TEST(ReadBars, ReadsBlurNoiseAndLowContrast) {
    for (const BarSample& sample : bar_samples) {
        BarScene blurred;
        blurred.blur = 1.4;
        BarScene noisy;
        noisy.noise = 20;
        BarScene faint;
        faint.dark = 192;
        faint.noise = 0.7;
        BarScene small;
        small.module = 1.1;
        small.degrees = 5;
        small.blur = 0.35;
        for (const BarScene& scene : {blurred, noisy, faint, small}) {
            EXPECT_EQ(read(picture_of(sample, scene)).text, sample.text);
        }
    }
}

TEST(ReadBars, SeveralCodesAreReadOnceEach) {
    Random random(3202);
    BarPicture picture({640, 480});
    const char* texts[] = {"9780905705712", "55123457", "FOVEA-1", "FOVEA-1"};
    const Symbology kinds[] = {Symbology::ean_13, Symbology::ean_8, Symbology::code_128, Symbology::code_128};
    for (int i = 0; i < 4; ++i) {
        BarScene scene;
        scene.module = 1.6;
        scene.x = i % 2 == 0 ? -150 : 150;
        scene.y = i < 2 ? -120 : 120;
        scene.degrees = 15 * i;
        draw_bars(picture, bars_of(kinds[i], texts[i]), scene, random);
    }
    ReadBarsOptions options;
    options.most_codes = 6;
    const BarAnswer all = read(picture, options);
    ASSERT_EQ(all.codes.size(), 4);
    for (int i = 0; i < 4; ++i) EXPECT_NE(all.text.find(texts[i]), std::string::npos);
    options.most_codes = 1;
    EXPECT_EQ(read(picture, options).codes.size(), 1);
}

TEST(ReadBars, AppendsAddOnsWhereTheyAreWanted) {
    Bars bars = bars_of(Symbology::ean_13, "9780905705712");
    bars.widths[bars.count++] = 9;
    ASSERT_EQ(encode_add_on(bytes_of("52495"), bars.view()), Status::ok);
    Random random(3203);
    BarPicture picture({520, 400});
    draw_bars(picture, bars, {}, random);
    EXPECT_EQ(read(picture).text, "9780905705712");
    ReadBarsOptions options;
    options.rules.add_on = AddOn::appended;
    const BarAnswer answer = read(picture, options);
    EXPECT_EQ(answer.text, "978090570571252495");
    EXPECT_EQ(answer.codes[0].aim_digit, '3');
    EXPECT_EQ(read(picture_of(bar_samples[0], {}), options).text, "9780905705712");
}

// Its last 8 was told as 2 at a blur of 0.6 modules, with the same check digit.
TEST(ReadBars, ABlurredUpcEIsNotMisread) {
    int read_ones = 0;
    for (const double module : {1.5, 2.0, 3.0, 4.0}) {
        for (const double blur : {0.4, 0.5, 0.55, 0.6, 0.65}) {
            BarScene scene;
            scene.module = module;
            scene.blur = blur * module;
            scene.degrees = 1;
            const std::string text = read(picture_of({Symbology::upc_e, "07913884"}, scene)).text;
            EXPECT_TRUE(text.empty() || text == "07913884") << text << " at " << module << ", " << blur;
            read_ones += text.empty() ? 0 : 1;
        }
    }
    EXPECT_GE(read_ones, 4);
}

TEST(ReadBars, GradesFallWithContrast) {
    BarScene scene;
    scene.module = 4;
    scene.dark = 5;
    scene.light = 250;
    scene.noise = 1;
    const Code good = read(picture_of(bar_samples[1], scene)).codes[0];
    EXPECT_EQ(good.grade.symbol_contrast, 4);
    EXPECT_GE(good.grade.overall, 3);
    scene.dark = 190;
    EXPECT_EQ(read(picture_of(bar_samples[1], scene)).codes[0].grade.symbol_contrast, 1);
}

/// Bars that blur has left few edges of, so that some are read only with all means.
BarScene hard_to_see(int which) {
    BarScene scene;
    scene.module = 2;
    scene.degrees = 5 * which;
    scene.blur = 1.2 + 0.1 * which;
    scene.noise = 3;
    return scene;
}

TEST(ReadBars, WhatEffortOneHasSeenNeedsNotBeSeenAgain) {
    int only_second[2] = {};
    for (const BarSample& sample : bar_samples) {
        for (int i = 0; i < 8; ++i) {
            const BarPicture picture =
                picture_of(sample, hard_to_see(i), static_cast<std::uint64_t>(3300 + i));
            for (const int most : {1, 2}) {
                ReadBarsOptions options;
                options.most_codes = most;
                options.effort = 1;
                if (read(picture, options).status != Status::not_found) continue;
                options.effort = 2;
                const BarAnswer whole = read(picture, options);
                const BarAnswer rest = read(picture, options, true);
                EXPECT_EQ(rest.status, whole.status) << sample.text << ' ' << i;
                EXPECT_EQ(rest.text, whole.text) << sample.text << ' ' << i;
                ASSERT_EQ(rest.codes.size(), whole.codes.size());
                for (int code = 0; code < whole.codes.size(); ++code) {
                    EXPECT_EQ(rest.codes[code].corners[0].x, whole.codes[code].corners[0].x);
                    EXPECT_EQ(rest.codes[code].agreeing_lines, whole.codes[code].agreeing_lines);
                }
                only_second[most - 1] += whole.status == Status::ok ? 1 : 0;
            }
        }
    }
    // As many as were read when every line was looked at again in every way.
    EXPECT_EQ(only_second[1], 16);
    EXPECT_GT(only_second[0], 0);
}

TEST(ReadBars, OneCodeIsLookedForTwiceInTheWeightiestField) {
    int twice = 0;
    for (const BarSample& sample : bar_samples) {
        for (int i = 0; i < 8; ++i) {
            const BarPicture picture =
                picture_of(sample, hard_to_see(i), static_cast<std::uint64_t>(3300 + i));
            ReadBarsOptions options;
            options.effort = 1;
            const BarAnswer one = read(picture, options);
            options.most_codes = 2;
            const BarAnswer two = read(picture, options);
            EXPECT_EQ(one.text, one.status == Status::ok ? sample.text : "");
            EXPECT_TRUE(one.status == Status::ok || two.status != Status::ok);
            twice += one.status == Status::ok && two.status != Status::ok ? 1 : 0;
        }
    }
    EXPECT_GT(twice, 3);
}

TEST(ReadBars, NoiseStripesAndTinyImagesHaveNothing) {
    Random random(3204);
    for (const Size size : {Size{1, 1}, Size{1, 60}, Size{60, 1}, Size{33, 17}, Size{300, 200}}) {
        BarPicture picture(size);
        EXPECT_EQ(read(picture).status, Status::not_found);
        for (Gray8& pixel : picture.pixels) pixel = static_cast<Gray8>(random.next() >> 24);
        EXPECT_TRUE(read(picture).codes.empty());
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                picture.view()(x, y) = x / 3 % 2 == 0 ? Gray8{20} : Gray8{220};
        EXPECT_EQ(read(picture).status, Status::not_found);
    }
}

TEST(ReadBars, ChecksItsArgumentsAndLeavesItsOutputs) {
    const BarPicture picture = picture_of(bar_samples[0], {});
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_bars_scratch(picture.size)));
    const Span<std::uint8_t> span(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::uint8_t room[12];
    CodeText text{Span<std::uint8_t>(room)};
    List<Code, 1> codes;
    EXPECT_EQ(read_bars({}, {}, span, text, codes), Status::empty_image);
    ReadBarsOptions wrong;
    wrong.most_codes = 0;
    EXPECT_EQ(read_bars(picture.view(), wrong, span, text, codes), Status::bad_argument);
    wrong = {};
    wrong.effort = 3;
    EXPECT_EQ(read_bars(picture.view(), wrong, span, text, codes), Status::bad_argument);
    wrong = {};
    wrong.agreeing_lines = 0;
    EXPECT_EQ(read_bars(picture.view(), wrong, span, text, codes), Status::bad_argument);
    wrong = {};
    wrong.rules.interleaved_shortest = 1;
    EXPECT_EQ(read_bars(picture.view(), wrong, span, text, codes), Status::bad_argument);
    EXPECT_EQ(read_bars(picture.view(), {}, span.first(span.size() - 1), text, codes),
              Status::scratch_too_small);
    EXPECT_EQ(read_bars(picture.view(), {}, span, text, codes), Status::buffer_too_small);
    EXPECT_EQ(text.size() + codes.size(), 0);
    std::uint8_t more[40];
    CodeText longer{Span<std::uint8_t>(more)};
    ASSERT_EQ(codes.push(Code()), Status::ok);
    EXPECT_EQ(read_bars(picture.view(), {}, span, longer, codes), Status::capacity_exceeded);
    EXPECT_EQ(longer.size(), 0);
}

}  // namespace
}  // namespace fovea::test
