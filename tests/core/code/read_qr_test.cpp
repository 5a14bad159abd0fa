// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "qr_scene.hpp"

namespace fovea::test {
namespace {

/// The one text of a picture, "" if there is none, and not one alone.
std::string only_text(const QrAnswer& answer) {
    return answer.texts.size() == 1 ? answer.texts[0] : std::to_string(answer.texts.size()) + " texts";
}
QrEncodeOptions of_version(int version, QrLevel level = QrLevel::medium) {
    QrEncodeOptions options;
    options.min_version = version;
    options.level = level;
    return options;
}

TEST(ReadQr, ReadsASymbolAndTellsItsCornersAndGrade) {
    QrScene scene(160, 150);
    scene.draw(DrawnQr("hello"), {80, 70, 4, 0, 0, 0, false});
    const QrAnswer answer = read_scene(scene);
    ASSERT_EQ(answer.status, Status::ok);
    ASSERT_EQ(only_text(answer), "hello");
    const Code& code = answer.codes[0];
    EXPECT_EQ(code.symbology, Symbology::qr);
    EXPECT_EQ(code.aim_digit, '1');
    EXPECT_EQ(code.corrected_errors, 0);
    EXPECT_FALSE(code.inverted);
    EXPECT_FALSE(code.mirrored);
    // 21 modules of 4 px around (80, 70); each of the two edges that meet is half a pixel off in the binary
    // image.
    const double expected[4][2] = {{38, 28}, {122, 28}, {122, 112}, {38, 112}};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(code.corners[i].x.raw() / 256.0, expected[i][0], 1) << i;
        EXPECT_NEAR(code.corners[i].y.raw() / 256.0, expected[i][1], 1) << i;
    }
    EXPECT_EQ(code.grade.symbol_contrast, 4);
    EXPECT_EQ(code.grade.modulation, 4);
    EXPECT_EQ(code.grade.quiet_zone, 4);
    EXPECT_EQ(code.grade.unused_error_correction, 4);
    EXPECT_EQ(code.grade.overall, 4);
    EXPECT_EQ(code.grade.decodability, CodeGrade::not_graded);
}

TEST(ReadQr, ReadsAtEveryAngle) {
    for (int degrees = 0; degrees < 360; degrees += 5) {
        QrScene scene(180, 180);
        const QrPose pose{90, 90, 4, degrees * pi / 180, 0, 0, false};
        scene.draw(DrawnQr("turned", of_version(2)), pose);
        const QrAnswer answer = read_scene(scene);
        ASSERT_EQ(only_text(answer), "turned") << degrees;
        // The first corner is where reading begins.
        double x = 0;
        double y = 0;
        pose.project(25, x, y);
        EXPECT_NEAR(answer.codes[0].corners[0].x.raw() / 256.0, x, 1.5) << degrees;
        EXPECT_NEAR(answer.codes[0].corners[0].y.raw() / 256.0, y, 1.5) << degrees;
    }
}

TEST(ReadQr, ReadsInPerspective) {
    const DrawnQr symbol("in perspective", of_version(4));
    for (int i = 0; i < 16; ++i) {
        QrScene scene(300, 300);
        scene.draw(symbol,
                   {150, 150, 5, i * pi / 8, 0.18 * std::cos(i * 1.3), 0.18 * std::sin(i * 1.3), false});
        EXPECT_EQ(only_text(read_scene(scene)), "in perspective") << i;
    }
}

TEST(ReadQr, ReadsWhatIsSeenInAMirrorOrLightOnDark) {
    const DrawnQr symbol("both ways");
    for (const bool inverted : {false, true}) {
        for (const bool mirrored : {false, true}) {
            QrScene scene(150, 150, inverted ? 20 : 220);
            const QrPose pose{75, 75, 4, 0.3, 0, 0, mirrored};
            scene.draw(symbol, pose, inverted ? 230 : 30);
            const QrAnswer answer = read_scene(scene);
            ASSERT_EQ(only_text(answer), "both ways");
            EXPECT_EQ(answer.codes[0].inverted, inverted);
            EXPECT_EQ(answer.codes[0].mirrored, mirrored);
            double x = 21;
            double y = 0;
            pose.project(21, x, y);
            EXPECT_NEAR(answer.codes[0].corners[1].x.raw() / 256.0, x, 1.5);
            EXPECT_NEAR(answer.codes[0].corners[1].y.raw() / 256.0, y, 1.5);
        }
    }
}

TEST(ReadQr, ReadsOnePixelAModuleWithoutAQuietZone) {
    for (const int version : {1, 2, 6, 7, 14, 22, 32, 40}) {
        const DrawnQr symbol("tiny", of_version(version));
        for (const int scale : {1, 2}) {
            QrScene scene(symbol.size() * scale, symbol.size() * scale, 255);
            scene.for_each(
                [&](int x, int y, double& value) { value = symbol.dark(x / scale, y / scale) ? 0 : 255; });
            const QrAnswer answer = read_scene(scene);
            EXPECT_EQ(only_text(answer), "tiny") << version << ' ' << scale;
            if (!answer.codes.empty()) {
                EXPECT_EQ(answer.codes[0].grade.quiet_zone, 0);
            }
        }
    }
}

TEST(ReadQr, ReadsLargeSymbolsByTheirAlignmentPatterns) {
    for (const int version : {10, 20, 30, 40}) {
        const DrawnQr symbol(std::string(static_cast<std::size_t>(20 * version), 'v'), of_version(version));
        const int side = symbol.size() * 4;
        QrScene scene(side, side);
        scene.draw(symbol, {side / 2.0, side / 2.0, 2.6, 0.35, 0.05, -0.04, false});
        EXPECT_EQ(only_text(read_scene(scene)), std::string(static_cast<std::size_t>(20 * version), 'v'))
            << version;
    }
}

TEST(ReadQr, ReadsABentSymbol) {
    const DrawnQr symbol("around a bottle", of_version(7));
    QrScene scene(320, 320);
    scene.for_each([&](int x, int y, double& value) {
        const double u = (x - 60) / 4.4;
        const double bend = (u - 22.5) / 22.5;
        if (symbol.dark(u, (y - 60) / 4.4 + 1.8 * bend * bend)) value = 30;
    });
    scene.blur(0.7);
    EXPECT_EQ(only_text(read_scene(scene)), "around a bottle");
}

TEST(ReadQr, ReadsBlurredNoisyAndUnevenlyLitSymbols) {
    Random random(131);
    const DrawnQr symbol("under a lamp", of_version(3));
    for (int round = 0; round < 12; ++round) {
        const QrPose pose{100, 100, 4.5, round * 0.5, 0, 0, false};
        QrScene blurred(200, 200);
        blurred.draw(symbol, pose);
        blurred.blur(2);
        EXPECT_EQ(only_text(read_scene(blurred)), "under a lamp") << round;
        QrScene noisy(200, 200);
        noisy.draw(symbol, pose);
        noisy.add_noise(random, 25);
        EXPECT_EQ(only_text(read_scene(noisy)), "under a lamp") << round;
        QrScene uneven(200, 200);
        uneven.draw(symbol, pose);
        uneven.for_each([&](int x, int, double& value) { value *= 0.15 + 0.85 * x / 200; });
        EXPECT_EQ(only_text(read_scene(uneven)), "under a lamp") << round;
        QrScene faint(200, 200, 120);
        faint.draw(symbol, pose, 100);
        EXPECT_EQ(only_text(read_scene(faint)), "under a lamp") << round;
    }
}

TEST(ReadQr, AShadowMayTouchAFinder) {
    QrScene scene(150, 150);
    scene.draw(DrawnQr("shadow"), {75, 75, 4, 0, 0, 0, false});
    scene.for_each([&](int x, int, double& value) {
        if (x < 33) value = 30;
    });
    EXPECT_EQ(only_text(read_scene(scene)), "shadow");
}

TEST(ReadQr, MendsDamage) {
    QrScene scene(150, 150);
    scene.draw(DrawnQr("damaged", of_version(2, QrLevel::high)), {75, 75, 4, 0.1, 0, 0, false});
    scene.for_each([&](int x, int y, double& value) {
        if (std::hypot(x - 80, y - 80) < 13) value = 220;
    });
    const QrAnswer answer = read_scene(scene);
    ASSERT_EQ(only_text(answer), "damaged");
    EXPECT_GT(answer.codes[0].corrected_errors, 2);
    EXPECT_LT(answer.codes[0].grade.unused_error_correction, 4);
}

TEST(ReadQr, ReadsAllSymbolsOfAnImage) {
    QrScene scene(400, 300);
    const std::vector<std::string> texts = {"one", "two", "three", "four"};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto index = static_cast<int>(i);
        scene.draw(DrawnQr(texts[i]),
                   {90.0 + 200 * (index % 2), 80.0 + 140 * (index / 2), 4, 0.2 + index, 0, 0, false});
    }
    QrAnswer answer = read_scene(scene);
    std::sort(answer.texts.begin(), answer.texts.end());
    EXPECT_EQ(answer.texts, (std::vector<std::string>{"four", "one", "three", "two"}));
    ReadQrOptions options;
    options.most_codes = 2;
    EXPECT_EQ(read_scene(scene, options).texts.size(), 2U);
}

TEST(ReadQr, ReadsNothingInNoiseAndStripes) {
    Random random(132);
    for (int round = 0; round < 20; ++round) {
        QrScene scene(random.between(1, 120), random.between(1, 120));
        const int stripe = random.between(1, 9);
        scene.for_each([&](int x, int y, double& value) {
            value = round % 2 == 0 ? random.between(0, 255) : (x / stripe + y / stripe) % 2 * 255;
        });
        EXPECT_EQ(read_scene(scene).status, Status::not_found);
    }
    EXPECT_EQ(read_scene(QrScene(1, 1)).status, Status::not_found);
    EXPECT_EQ(read_scene(QrScene(300, 2)).status, Status::not_found);
}

TEST(ReadQr, QuickIsOneThreshold) {
    ReadQrOptions quick;
    quick.effort = ReadQrOptions::Effort::quick;
    QrScene scene(150, 150);
    EXPECT_EQ(read_scene(scene, quick).status, Status::not_found);
    scene.draw(DrawnQr("quick"), {75, 75, 4, 0.4, 0, 0, false});
    EXPECT_EQ(only_text(read_scene(scene, quick)), "quick");
}

bool same_code(const Code& a, const Code& b) {
    for (int i = 0; i < 4; ++i)
        if (!(a.corners[i].x == b.corners[i].x && a.corners[i].y == b.corners[i].y)) return false;
    return a.corrected_errors == b.corrected_errors && a.aim_digit == b.aim_digit &&
           a.inverted == b.inverted && a.mirrored == b.mirrored && a.grade.overall == b.grade.overall &&
           a.grade.modulation == b.grade.modulation &&
           a.grade.unused_error_correction == b.grade.unused_error_correction;
}

TEST(ReadQr, FewerVersionsAreReadAsAllAreAndLargerOnesAreNot) {
    Random random(3041);
    ReadQrOptions few;
    few.effort = ReadQrOptions::Effort::several;
    for (int version = 1; version <= 8; ++version) {
        QrScene scene(320, 240);
        scene.draw(DrawnQr("few", of_version(version)), {160, 120, 4, version * 0.4, 0, 0, false});
        scene.blur(0.6);
        scene.add_noise(random, 6);
        const QrAnswer all = read_scene(scene);
        ASSERT_EQ(only_text(all), "few") << version;
        few.largest_version = version;
        const QrAnswer limited = read_scene(scene, few);
        ASSERT_EQ(only_text(limited), "few") << version;
        EXPECT_TRUE(same_code(all.codes[0], limited.codes[0])) << version;
        if (version == 1) continue;
        few.largest_version = version - 1;
        EXPECT_EQ(read_scene(scene, few).status, Status::not_found) << version;
    }
}

TEST(ReadQr, FewerVersionsAndThresholdsNeedLessScratch) {
    ReadQrOptions few;
    few.effort = ReadQrOptions::Effort::several;
    few.largest_version = 6;
    // With a frame of 75 KiB, and 7 KiB for all else, 100 KiB.
    EXPECT_LT(read_qr_scratch({320, 240}, few), 18 * 1024);
    const Size large{400, 400};
    few.largest_version = 40;
    const std::int64_t every_version = read_qr_scratch(large, few);
    few.largest_version = 1;
    EXPECT_LT(read_qr_scratch(large, few), every_version);
    few.effort = ReadQrOptions::Effort::quick;
    EXPECT_LE(read_qr_scratch(large, few), every_version);
    // No image shows more modules than it has pixels, and four.
    few = {};
    const std::int64_t small = read_qr_scratch({41, 41});
    few.largest_version = 7;
    EXPECT_EQ(read_qr_scratch({41, 41}, few), small);
}

TEST(ReadQr, SeveralThresholdsReadWhatOneDoesNot) {
    // Two grey levels that are nearer than blocks tell apart: the threshold of the whole image does.
    QrScene scene(160, 150, 140);
    scene.draw(DrawnQr("faint"), {80, 75, 4, 0, 0, 0, false}, 122);
    ReadQrOptions options;
    options.effort = ReadQrOptions::Effort::quick;
    EXPECT_EQ(read_scene(scene, options).status, Status::not_found);
    options.effort = ReadQrOptions::Effort::several;
    EXPECT_EQ(only_text(read_scene(scene, options)), "faint");
}

TEST(ReadQr, SaysWhatIsWrong) {
    QrScene scene(100, 100);
    scene.draw(DrawnQr("hello"), {50, 50, 4, 0, 0, 0, false});
    const std::vector<Gray8> pixels = scene.pixels();
    const ImageView<const Gray8> image(pixels.data(), {100, 100}, 100);
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(read_qr_scratch({100, 100})));
    const Span<std::uint8_t> whole(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::uint8_t room[8] = {};
    CodeText text({room, 4});
    List<Code, 1> codes;
    EXPECT_EQ(read_qr({}, {}, whole, text, codes), Status::empty_image);
    ReadQrOptions none;
    none.most_codes = 0;
    EXPECT_EQ(read_qr(image, none, whole, text, codes), Status::bad_argument);
    for (const int version : {0, 41}) {
        ReadQrOptions wrong;
        wrong.largest_version = version;
        EXPECT_EQ(read_qr(image, wrong, whole, text, codes), Status::bad_argument);
    }
    EXPECT_EQ(read_qr(image, {}, whole.from(1), text, codes), Status::scratch_too_small);
    EXPECT_EQ(read_qr(image, {}, whole, text, codes), Status::buffer_too_small);
    EXPECT_EQ(text.size(), 0);
    EXPECT_TRUE(codes.empty());

    CodeText fitting(room);
    ASSERT_EQ(read_qr(image, {}, whole, fitting, codes), Status::ok);
    CodeText more(room);
    EXPECT_EQ(read_qr(image, {}, whole, more, codes), Status::capacity_exceeded);
    EXPECT_EQ(more.size(), 0);
    EXPECT_EQ(codes.size(), 1);
}

}  // namespace
}  // namespace fovea::test
