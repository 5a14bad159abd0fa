// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/checkerboard.hpp>
#include <support/board_scene.hpp>
#include <support/code_photos.hpp>
#include <support/guarded_image.hpp>

namespace fovea::test {
namespace {

struct Found {
    Status status = Status::ok;
    std::vector<SubPixelPoint> corners;
};
Found find(ImageView<const Gray8> view, Size board, const CheckerboardOptions& options = {}) {
    Found found;
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(find_checkerboard_scratch(view.size(), board, options)), 0xa5);
    found.corners.resize(static_cast<std::size_t>(board.area()));
    found.status =
        find_checkerboard(view, board, options, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())},
                          {found.corners.data(), static_cast<std::ptrdiff_t>(board.area())});
    return found;
}
BoardPicture draw(const BoardScene& scene) {
    Random random(11);
    return BoardView(scene).render(random);
}
/// The largest distance from the truth, with corner (column, row) of the scene where place() puts it.
template <class Place>
double worst(const BoardScene& scene, const Found& found, Place place) {
    const BoardView view(scene);
    double result = 0;
    for (int row = 0; row < scene.board.height; ++row)
        for (int column = 0; column < scene.board.width; ++column) {
            const Seen seen = view(column, row);
            const SubPixelPoint p = found.corners[static_cast<std::size_t>(place(column, row))];
            result = std::max(result, std::hypot(p.x.raw() / 256.0 - seen.x, p.y.raw() / 256.0 - seen.y));
        }
    return result;
}
double worst(const BoardScene& scene, const Found& found) {
    return worst(scene, found, [&](int column, int row) { return row * scene.board.width + column; });
}

TEST(Checkerboard, IsFoundInItsOrderHoweverItTurns) {
    BoardScene scene;
    scene.picture = {160, 140};
    scene.board = {6, 5};
    scene.step = 13;
    for (int roll = 0; roll < 360; roll += 45) {
        scene.roll = roll;
        const Found found = find(draw(scene).view(), scene.board);
        ASSERT_EQ(found.status, Status::ok) << roll;
        EXPECT_LT(worst(scene, found), 0.03) << roll;
    }
}

TEST(Checkerboard, ThatIsTwiceTheSameBeginsWhereItsRowRunsRight) {
    BoardScene scene;
    scene.picture = {160, 140};
    scene.step = 14;
    for (const Size board : {Size{5, 5}, Size{6, 4}, Size{4, 4}})
        for (int roll = 10; roll < 360; roll += 180) {
            scene.board = board;
            scene.roll = roll;
            const Found found = find(draw(scene).view(), board);
            ASSERT_EQ(found.status, Status::ok) << roll;
            const SubPixelPoint first = found.corners.front();
            const SubPixelPoint last = found.corners[static_cast<std::size_t>(board.width) - 1];
            // Of boards with odd sides, those beginning in a dark corner; their rows may run up or down.
            if (roll == 10 || roll == 190) {
                EXPECT_GT(last.x, first.x);
            }
        }
}

TEST(Checkerboard, OfAMirrorHasTheOrderThatItsColoursGive) {
    // Mirrored in a vertical line; dark outer squares are those at the ends of the first column again.
    BoardScene scene;
    scene.picture = {160, 140};
    scene.board = {6, 5};
    scene.step = 13;
    scene.roll = 20;
    const BoardPicture picture = draw(scene);
    BoardPicture mirrored(picture.size);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x)
            mirrored.view()(x, y) = picture.view()(picture.size.width - 1 - x, y);
    Found found = find(mirrored.view(), scene.board);
    ASSERT_EQ(found.status, Status::ok);
    for (SubPixelPoint& p : found.corners) p.x = SubPixel::from_int(picture.size.width - 1) - p.x;
    const double straight = worst(scene, found, [](int c, int r) { return r * 6 + 5 - c; });
    const double turned = worst(scene, found, [](int c, int r) { return (4 - r) * 6 + c; });
    EXPECT_LT(std::min(straight, turned), 0.03);
}

TEST(Checkerboard, IsFoundTiltedBlurredNoisyAndInUnevenLight) {
    struct Case {
        double tilt, blur, noise, light, most;
    };
    // The last column is what the same scene gives with other seeds, doubled.
    for (const Case& c : {Case{60, 0.7, 0, 1, 0.05}, Case{30, 4, 2, 1, 0.2}, Case{30, 0.7, 15, 1, 0.8},
                          Case{30, 1, 2, 0.1, 0.6}}) {
        BoardScene scene;
        scene.step = 20;
        scene.tilt = c.tilt;
        scene.blur = c.blur;
        scene.noise = c.noise;
        scene.light = c.light;
        const Found found = find(draw(scene).view(), scene.board);
        ASSERT_EQ(found.status, Status::ok) << c.tilt << ' ' << c.blur << ' ' << c.noise << ' ' << c.light;
        EXPECT_LT(worst(scene, found), c.most) << c.tilt << ' ' << c.blur << ' ' << c.noise << ' ' << c.light;
    }
}

TEST(Checkerboard, IsFoundSmallLargeAndBesideTheEdgeOfTheImage) {
    BoardScene scene;
    scene.picture = {96, 64};
    scene.step = 7;
    Found found = find(draw(scene).view(), scene.board);
    ASSERT_EQ(found.status, Status::ok);
    EXPECT_LT(worst(scene, found), 0.15);

    scene.picture = {200, 150};
    scene.step = 24;  // 192 pixels from the first corner to the last: outer squares are cut off
    found = find(draw(scene).view(), scene.board);
    ASSERT_EQ(found.status, Status::ok);
    EXPECT_LT(worst(scene, found), 0.15);

    scene.board = {14, 13};
    scene.step = 9;
    scene.board.height = 12;
    found = find(draw(scene).view(), {14, 12});
    EXPECT_EQ(found.status, Status::ok);
}

TEST(Checkerboard, IsNotFoundWhereACornerIsHiddenOrOutside) {
    BoardScene scene;
    BoardPicture picture = draw(scene);
    ASSERT_EQ(find(picture.view(), scene.board).status, Status::ok);
    for (const int corner : {0, 8, 22, 53}) {
        const Seen seen = BoardView(scene)(corner % 9, corner / 9);
        BoardPicture hidden = picture;
        for (int y = -8; y <= 8; ++y)
            for (int x = -8; x <= 8; ++x)
                hidden.view()(static_cast<int>(seen.x) + x, static_cast<int>(seen.y) + y) = 120;
        EXPECT_EQ(find(hidden.view(), scene.board).status, Status::not_found) << corner;
    }
    scene.x = 75;
    EXPECT_EQ(find(draw(scene).view(), scene.board).status, Status::not_found);
}

TEST(Checkerboard, OfAnotherSizeIsNotFound) {
    BoardScene scene;
    const BoardPicture picture = draw(scene);
    for (const Size board :
         {Size{8, 6}, Size{9, 5}, Size{10, 6}, Size{9, 7}, Size{8, 5}, Size{3, 3}, Size{64, 64}})
        EXPECT_EQ(find(picture.view(), board).status, Status::not_found)
            << board.width << 'x' << board.height;
    EXPECT_EQ(find(picture.view(), {6, 9}).status, Status::ok);
}

TEST(Checkerboard, IsNotFoundInNoiseGridsAndDots) {
    Random random(5);
    GuardedImage<Gray8> image({160, 120});
    image.fill(random);
    EXPECT_EQ(find(image.view(), {3, 3}).status, Status::not_found);
    for (const int pitch : {8, 12, 20})
        for (const int width : {1, 2, 4}) {
            for (int y = 0; y < 120; ++y)
                for (int x = 0; x < 160; ++x)
                    image(x, y) = x % pitch < width || y % pitch < width ? Gray8{30} : Gray8{220};
            for (const Size board : {Size{3, 3}, Size{7, 5}})
                EXPECT_EQ(find(image.view(), board).status, Status::not_found) << pitch << ' ' << width;
        }
    // From afar a checkerboard on a corner.
    for (const double radius : {0.25, 0.35, 0.45}) {
        BoardScene scene;
        scene.pattern = BoardPattern::circles;
        scene.radius = radius;
        scene.picture = {160, 120};
        scene.step = 14;
        const BoardPicture picture = draw(scene);
        for (const Size board : {Size{3, 3}, Size{4, 3}, Size{8, 5}})
            EXPECT_EQ(find(picture.view(), board).status, Status::not_found) << radius;
    }
}

TEST(Checkerboard, HasSquaresOfTwoColoursBetweenItsCorners) {
    BoardScene scene;
    scene.picture = {160, 120};
    scene.step = 13;
    Found found = find(draw(scene).view(), scene.board);
    ASSERT_EQ(found.status, Status::ok);
    const detail::BoardPlaces places({found.corners.data(), 54}, scene.board);
    EXPECT_TRUE(detail::is_even(places));
    EXPECT_TRUE(detail::is_checkered(draw(scene).view(), places, false));
    EXPECT_FALSE(detail::is_checkered(draw(scene).view(), places, true));
    EXPECT_FALSE(detail::is_part(draw(scene).view(), places, false));
    // The same places on dots, and on nothing.
    scene.pattern = BoardPattern::circles;
    EXPECT_FALSE(detail::is_checkered(draw(scene).view(), places, false));
    BoardPicture flat(scene.picture);
    EXPECT_FALSE(detail::is_checkered(flat.view(), places, false));
    // A place that is off by a third of a step.
    found.corners[20].x += SubPixel::from_int(5);
    EXPECT_FALSE(detail::is_even(places));
    // Eight by six of nine by six.
    scene.pattern = BoardPattern::checkerboard;
    found = find(draw(scene).view(), scene.board);
    std::vector<SubPixelPoint> part;
    for (int k = 0; k < 54; ++k)
        if (k % 9 < 8) part.push_back(found.corners[static_cast<std::size_t>(k)]);
    EXPECT_TRUE(detail::is_part(draw(scene).view(), {{part.data(), 48}, {8, 6}}, false));
}

TEST(Checkerboard, DoesNotDependOnTheStride) {
    BoardScene scene;
    scene.picture = {131, 97};
    scene.step = 10;
    scene.noise = 3;
    const BoardPicture picture = draw(scene);
    GuardedImage<Gray8> wide({131, 97}, 29);
    for (int y = 0; y < 97; ++y) std::memcpy(wide.view().row(y), picture.view().row(y), 131);
    const Found a = find(picture.view(), scene.board);
    const Found b = find(wide.view(), scene.board);
    ASSERT_EQ(a.status, Status::ok);
    EXPECT_EQ(a.corners, b.corners);
}

TEST(Checkerboard, RefusesWhatItCannotTake) {
    const CheckerboardOptions options;
    GuardedImage<Gray8> image({40, 30});
    image.fill(9);
    const ImageView<const Gray8> view = image.view();
    std::vector<std::uint8_t> scratch(
        static_cast<std::size_t>(find_checkerboard_scratch({40, 30}, {9, 6}, options)));
    const Span<std::uint8_t> all(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
    std::vector<SubPixelPoint> corners(54);
    const Span<SubPixelPoint> places(corners.data(), 54);
    EXPECT_EQ(find_checkerboard({}, {9, 6}, options, all, places), Status::empty_image);
    for (const Size board : {Size{2, 6}, Size{9, 2}, Size{65, 6}, Size{9, 65}, Size{0, 0}, Size{-9, -6}}) {
        EXPECT_EQ(find_checkerboard(view, board, options, all, places), Status::bad_argument);
        EXPECT_EQ(find_checkerboard_scratch({40, 30}, board, options), 0);
    }
    for (const int bad : {3, 256, -1}) {
        CheckerboardOptions wrong;
        wrong.least_contrast = bad;
        EXPECT_EQ(find_checkerboard(view, {9, 6}, wrong, all, places), Status::bad_argument);
        wrong = {};
        wrong.candidates = bad == 256 ? 8193 : bad;
        EXPECT_EQ(find_checkerboard(view, {9, 6}, wrong, all, places), Status::bad_argument);
    }
    EXPECT_EQ(find_checkerboard(view, {9, 6}, options, all.first(all.size() - 1), places),
              Status::scratch_too_small);
    EXPECT_EQ(find_checkerboard(view, {9, 6}, options, all, places.first(53)), Status::buffer_too_small);
    EXPECT_EQ(find_checkerboard(view, {9, 6}, options, all, places), Status::not_found);
    for (const SubPixelPoint p : corners) EXPECT_EQ(p, SubPixelPoint());
    for (const Size size : {Size{1, 1}, Size{1, 40}, Size{40, 1}, Size{6, 6}, Size{7, 7}}) {
        GuardedImage<Gray8> small(size);
        EXPECT_EQ(find(small.view(), {3, 3}).status, Status::not_found);
    }
}

// Corners as another finder has them (OpenCV 4.6, cornerSubPix with a window of 23 pixels): the first and
// the last of each view. They say which corner is the first; some are 6 px off, pulled beyond a square.
TEST(Checkerboard, IsFoundInAllPhotosOfAStereoRig) {
    const int ends[26][4] = {
        {244, 94, 510, 266}, {256, 362, 540, 133}, {277, 72, 545, 391},  {189, 131, 522, 338},
        {436, 50, 289, 432}, {589, 139, 390, 387}, {369, 138, 151, 335}, {471, 93, 185, 371},
        {219, 86, 469, 314}, {414, 66, 302, 430},  {423, 71, 199, 409},  {402, 72, 312, 375},
        {416, 57, 280, 423}, {128, 111, 381, 279}, {128, 372, 328, 140}, {133, 89, 363, 411},
        {58, 149, 352, 355}, {288, 59, 101, 436},  {461, 145, 271, 400}, {242, 150, 50, 344},
        {321, 101, 42, 376}, {65, 107, 343, 328},  {273, 77, 146, 437},  {276, 81, 41, 411},
        {240, 84, 193, 386}, {265, 68, 135, 430}};
    int view = 0;
    for (const char* side : {"left", "right"})
        for (const int number : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14}) {
            const std::string name =
                std::string(side) + (number < 10 ? "0" : "") + std::to_string(number) + ".jpg";
            FOVEA_NEED_PICTURE(opencv_doc_folder() / name);
            const Picture<Gray8> photo = load_photo(opencv_doc_folder() / name);
            const Found found = find(photo.view(), {9, 6});
            EXPECT_EQ(found.status, Status::ok) << name;
            if (found.status != Status::ok) continue;
            EXPECT_NEAR(found.corners.front().x.raw() / 256.0, ends[view][0], 7) << name;
            EXPECT_NEAR(found.corners.front().y.raw() / 256.0, ends[view][1], 7) << name;
            EXPECT_NEAR(found.corners.back().x.raw() / 256.0, ends[view][2], 7) << name;
            EXPECT_NEAR(found.corners.back().y.raw() / 256.0, ends[view][3], 7) << name;
            EXPECT_EQ(find(photo.view(), {8, 6}).status, Status::not_found) << name;
            ++view;
        }
}

TEST(Checkerboard, IsNotFoundInOtherPhotos) {
    for (const char* name :
         {"building.jpg", "home.jpg", "sudoku.png", "board.jpg", "aero1.jpg", "text_defocus.jpg"}) {
        FOVEA_NEED_PICTURE(opencv_doc_folder() / name);
        const Picture<Gray8> photo = load_photo(opencv_doc_folder() / name);
        ASSERT_FALSE(photo.size.empty()) << name;
        for (const Size board : {Size{3, 3}, Size{9, 6}})
            EXPECT_EQ(find(photo.view(), board).status, Status::not_found) << name;
    }
}

}  // namespace
}  // namespace fovea::test
