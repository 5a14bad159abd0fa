// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/circle_grid.hpp>
#include <support/board_scene.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status = Status::ok;
    std::vector<SubPixelPoint> centres;
};
Found find(ImageView<const Gray8> view, Size board, const CircleGridOptions& options) {
    Found found;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(find_circle_grid_scratch(view.size(), board, options)), 0xa5);
    found.centres.resize(static_cast<std::size_t>(board.area()));
    found.status =
        find_circle_grid(view, board, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                         {found.centres.data(), static_cast<std::ptrdiff_t>(board.area())});
    return found;
}
BoardPicture draw(const BoardScene& scene) {
    Random random(11);
    return BoardView(scene).render(random);
}
double worst(const BoardScene& scene, const Found& found) {
    const BoardView view(scene);
    double result = 0;
    for (int row = 0; row < scene.board.height; ++row)
        for (int column = 0; column < scene.board.width; ++column) {
            const Seen seen = view(column, row);
            const SubPixelPoint p = found.centres[static_cast<std::size_t>(row * scene.board.width + column)];
            result = std::max(result, std::hypot(p.x.raw() / 256.0 - seen.x, p.y.raw() / 256.0 - seen.y));
        }
    return result;
}
BoardScene symmetric() {
    BoardScene scene;
    scene.picture = {160, 120};
    scene.pattern = BoardPattern::circles;
    scene.board = {6, 4};
    scene.step = 16;
    return scene;
}
BoardScene asymmetric() {
    BoardScene scene = symmetric();
    scene.pattern = BoardPattern::asymmetric_circles;
    scene.board = {4, 7};
    scene.step = 11;
    scene.radius = 0.45;
    return scene;
}
CircleGridOptions options_of(const BoardScene& scene) {
    CircleGridOptions options;
    if (scene.pattern == BoardPattern::asymmetric_circles) options.pattern = CircleGridPattern::asymmetric;
    options.tone = scene.inverted ? CircleTone::bright : CircleTone::dark;
    return options;
}

TEST(CircleGrid, IsFoundDarkAndBright) {
    for (BoardScene scene : {symmetric(), asymmetric()})
        for (const bool inverted : {false, true}) {
            scene.inverted = inverted;
            const BoardPicture picture = draw(scene);
            CircleGridOptions options = options_of(scene);
            const Found found = find(picture.view(), scene.board, options);
            ASSERT_EQ(found.status, Status::ok);
            // Seen straight on, half a level of 170 along a rim of about 30 pixels is far below 0.03 px.
            EXPECT_LT(worst(scene, found), 0.03);
            options.tone = CircleTone::any;
            EXPECT_EQ(find(picture.view(), scene.board, options).centres, found.centres);
            options.tone = inverted ? CircleTone::dark : CircleTone::bright;
            EXPECT_EQ(find(picture.view(), scene.board, options).status, Status::not_found);
        }
}

TEST(CircleGrid, WithAnOddNumberOfShiftedRowsHasOneOrder) {
    BoardScene scene = asymmetric();
    scene.picture = {150, 150};
    for (int roll = 0; roll < 360; roll += 120) {
        scene.roll = roll;
        const Found found = find(draw(scene).view(), scene.board, options_of(scene));
        ASSERT_EQ(found.status, Status::ok) << roll;
        EXPECT_LT(worst(scene, found), 0.03) << roll;
    }
}

TEST(CircleGrid, WithColumnsAndRowsBeginsWhereItsRowRunsRight) {
    BoardScene scene = symmetric();
    scene.picture = {150, 150};
    for (const int roll : {0, 70, 110, 250}) {
        scene.roll = roll;
        const Found found = find(draw(scene).view(), scene.board, options_of(scene));
        ASSERT_EQ(found.status, Status::ok) << roll;
        EXPECT_GE(found.centres[5].x, found.centres[0].x) << roll;
        scene.roll = roll > 90 && roll < 270 ? roll - 180 : roll;
        EXPECT_LT(worst(scene, found), 0.03) << roll;
    }
}

// The middle of an ellipse is not where the middle of its circle is seen: with these tilts off by 0.2 px.
TEST(CircleGrid, IsFoundTiltedBlurredNoisyAndInUnevenLight) {
    struct Case {
        double tilt, blur, noise, light;
    };
    for (const Case& c :
         {Case{55, 0.7, 0, 1}, Case{20, 2, 1, 1}, Case{20, 0.7, 12, 1}, Case{20, 0.7, 1, 0.2}})
        for (BoardScene scene : {symmetric(), asymmetric()}) {
            scene.tilt = c.tilt;
            scene.blur = c.blur;
            scene.noise = c.noise;
            scene.light = c.light;
            const Found found = find(draw(scene).view(), scene.board, options_of(scene));
            ASSERT_EQ(found.status, Status::ok)
                << c.tilt << ' ' << c.blur << ' ' << c.noise << ' ' << c.light;
            EXPECT_LT(worst(scene, found), 0.6);
        }
}

TEST(CircleGrid, IsNotFoundWhereACircleIsHiddenOrOneMoreStands) {
    for (const BoardScene& scene : {symmetric(), asymmetric()}) {
        BoardPicture picture = draw(scene);
        const Size board = scene.board;
        EXPECT_EQ(find(picture.view(), {board.width - 1, board.height}, options_of(scene)).status,
                  Status::not_found);
        EXPECT_EQ(find(picture.view(), {board.width, board.height - 1}, options_of(scene)).status,
                  Status::not_found);
        EXPECT_EQ(find(picture.view(), {board.width + 1, board.height}, options_of(scene)).status,
                  Status::not_found);
        EXPECT_EQ(find(picture.view(), {3, 3}, options_of(scene)).status, Status::not_found);
        const Seen seen = BoardView(scene)(1, 2);
        for (int y = -6; y <= 6; ++y)
            for (int x = -6; x <= 6; ++x)
                picture.view()(static_cast<int>(seen.x) + x, static_cast<int>(seen.y) + y) = 210;
        EXPECT_EQ(find(picture.view(), board, options_of(scene)).status, Status::not_found);
    }
}

TEST(CircleGrid, IsNotFoundInNoiseSquaresAndFlatImages) {
    Random random(5);
    GuardedImage<Gray8> image({160, 120});
    image.fill(Gray8{7});
    CircleGridOptions options;
    options.tone = CircleTone::any;
    EXPECT_EQ(find(image.view(), {3, 3}, options).status, Status::not_found);
    image.fill(random);
    EXPECT_EQ(find(image.view(), {3, 3}, options).status, Status::not_found);
    BoardScene scene;
    scene.picture = {160, 120};
    scene.step = 11;
    EXPECT_EQ(find(draw(scene).view(), {3, 3}, options).status, Status::not_found);
}

TEST(CircleGrid, OfALargeImageIsLookedForInItsHalf) {
    BoardScene scene = symmetric();
    scene.picture = {1100, 120};
    scene.focal = 0.2;
    const Found found = find(draw(scene).view(), scene.board, options_of(scene));
    ASSERT_EQ(found.status, Status::ok);
    EXPECT_LT(worst(scene, found), 0.03);
}

TEST(CircleGrid, DoesNotDependOnTheStride) {
    const BoardScene scene = symmetric();
    const BoardPicture picture = draw(scene);
    GuardedImage<Gray8> wide({160, 120}, 29);
    for (int y = 0; y < 120; ++y) std::memcpy(wide.view().row(y), picture.view().row(y), 160);
    EXPECT_EQ(find(picture.view(), scene.board, {}).centres, find(wide.view(), scene.board, {}).centres);
}

TEST(CircleGrid, RefusesWhatItCannotTake) {
    const CircleGridOptions options;
    GuardedImage<Gray8> image({40, 30});
    image.fill(Gray8{9});
    const ImageView<const Gray8> view = image.view();
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(find_circle_grid_scratch({40, 30}, {4, 5}, options)));
    const Span<std::uint8_t> all(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::vector<SubPixelPoint> centres(20);
    const Span<SubPixelPoint> places(centres.data(), 20);
    EXPECT_EQ(find_circle_grid({}, {4, 5}, options, all, places), Status::empty_image);
    const std::vector<Gray8> line(8192);
    EXPECT_EQ(find_circle_grid({line.data(), {8192, 1}, 8192}, {4, 5}, options, all, places),
              Status::image_too_large);
    for (const Size board : {Size{2, 5}, Size{4, 2}, Size{65, 5}, Size{4, 65}, Size{0, 0}, Size{-4, -5}}) {
        EXPECT_EQ(find_circle_grid(view, board, options, all, places), Status::bad_argument);
        EXPECT_EQ(find_circle_grid_scratch({40, 30}, board, options), 0);
    }
    CircleGridOptions wrong[6];
    wrong[0].least_contrast = 3;
    wrong[1].least_contrast = 256;
    wrong[2].candidates = 15;
    wrong[3].candidates = 8193;
    wrong[4].pattern = static_cast<CircleGridPattern>(2);
    wrong[5].tone = static_cast<CircleTone>(3);
    for (const CircleGridOptions& bad : wrong)
        EXPECT_EQ(find_circle_grid(view, {4, 5}, bad, all, places), Status::bad_argument);
    EXPECT_EQ(find_circle_grid(view, {4, 5}, options, all.first(all.size() - 1), places),
              Status::scratch_too_small);
    EXPECT_EQ(find_circle_grid(view, {4, 5}, options, all, places.first(19)), Status::buffer_too_small);
    EXPECT_EQ(find_circle_grid(view, {4, 5}, options, all, places), Status::not_found);
    for (const SubPixelPoint p : centres) EXPECT_EQ(p, SubPixelPoint());
    for (const Size size : {Size{1, 1}, Size{1, 40}, Size{40, 1}})
        EXPECT_EQ(find(GuardedImage<Gray8>(size).view(), {3, 3}, options).status, Status::not_found);
}

}  // namespace
}  // namespace fovea::test
