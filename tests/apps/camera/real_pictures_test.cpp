// SPDX-License-Identifier: MIT
//
// The toolkit's own pairs of pictures, with its calibrations of their cameras.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <camera/load_camera.hpp>
#include <camera/new_picture.hpp>
#include <camera/rectified_pair.hpp>
#include <support/picture.hpp>
#include <support/test_io.hpp>

namespace fovea::test {
namespace {

using apps::CameraFile;
using apps::Picture;
using apps::PictureMap;

std::filesystem::path ivt(const char* name) { return data_folder() / "ivt" / name; }

Picture<Gray8> gray(const char* name) {
    TestIo io;
    io.put("p.bmp", read_file(ivt(name)));
    Picture<Gray8> picture;
    std::string problem;
    EXPECT_TRUE(apps::load_picture(io.storage(), "p.bmp", 10000, picture, problem)) << problem;
    return picture;
}
CameraFile cameras(const char* name) {
    const std::vector<std::uint8_t> bytes = read_file(ivt(name));
    const CameraFile file = apps::read_camera(std::string(bytes.begin(), bytes.end()));
    EXPECT_EQ(file.problem, "");
    return file;
}
Picture<Gray8> warped(const Picture<Gray8>& picture, const PictureMap& map) {
    Picture<Gray8> result(map.size);
    EXPECT_EQ(remap<Gray8>(picture.view(), map.view(), {}, result.view()), Status::ok);
    return result;
}

/// How far the dark gap between two doors near x = 540 is from a straight line, as the root of the mean
///     square.
double gap_off_line(const Picture<Gray8>& picture, int from_x, int to_x, int rows) {
    std::vector<double> places;
    for (int y = 0; y < rows; ++y) {
        int darkest = from_x;
        for (int x = from_x; x <= to_x; ++x)
            if (picture.view()(x, y) < picture.view()(darkest, y)) darkest = x;
        // The middle of what is dark, weighed.
        double sum = 0, moment = 0;
        for (int x = darkest - 4; x <= darkest + 4; ++x) {
            const int level = std::max(picture.view()(darkest - 5, y), picture.view()(darkest + 5, y));
            const double dark = std::max(0, level - picture.view()(x, y));
            sum += dark;
            moment += dark * x;
        }
        places.push_back(moment / sum);
    }
    const double n = rows;
    double sx = 0, sy = 0, syy = 0, sxy = 0;
    for (int y = 0; y < rows; ++y) {
        sx += places[static_cast<std::size_t>(y)];
        sy += y;
        syy += y * y;
        sxy += y * places[static_cast<std::size_t>(y)];
    }
    const double slope = (n * sxy - sx * sy) / (n * syy - sy * sy);
    const double start = (sx - slope * sy) / n;
    double square = 0;
    for (int y = 0; y < rows; ++y)
        square += std::pow(places[static_cast<std::size_t>(y)] - start - slope * y, 2);
    return std::sqrt(square / n);
}

TEST(ToolkitCameras, IdealCornerIsWhereTheToolkitHasIt) {
    FOVEA_NEED_PICTURE(ivt("camera_armar_640x480_4mm.txt"));
    const CameraFile file = cameras("camera_armar_640x480_4mm.txt");
    ASSERT_TRUE(file.stereo());
    const LensInverse<> lens(file.cameras[0].camera);
    const auto map = undistortion_map(lens, Matrix<3, 3>::identity(), file.cameras[0].camera, {640, 480});
    ASSERT_TRUE(map.ok());
    EXPECT_NEAR(map->place(0, 0).x.raw() / 65536.0, 61.30, 0.01);
    EXPECT_NEAR(map->place(0, 0).y.raw() / 65536.0, 43.71, 0.01);
    const auto corner = lens.ray(Vector<2>());
    ASSERT_TRUE(corner.ok());
    const Vector<2> ideal = pixel_of(file.cameras[0].camera, Vector<2>((*corner)[0], (*corner)[1]));
    EXPECT_EQ(ideal[0].rounded(0), -99);
    EXPECT_EQ((ideal[0] * Real::from_int(100)).rounded(0), -9867);
    EXPECT_EQ((ideal[1] * Real::from_int(100)).rounded(0), -7057);
}

TEST(ToolkitCameras, ADoorIsStraightWhenUndistorted) {
    FOVEA_NEED_PICTURE(ivt("distorted_left.bmp"));
    const CameraFile file = cameras("camera_armar_640x480_4mm.txt");
    ASSERT_TRUE(file.stereo());
    const Picture<Gray8> before = gray("distorted_left.bmp");
    PictureMap map;
    ASSERT_EQ(apps::make_map(LensInverse<>(file.cameras[0].camera), Matrix<3, 3>::identity(),
                             file.cameras[0].camera, before.size, before.size, map),
              Status::ok);
    const double bent = gap_off_line(before, 510, 565, 325);
    const double straight = gap_off_line(warped(before, map), 530, 585, 325);
    std::printf("door gap: %.2f px off a straight line before, %.2f after\n", bent, straight);
    EXPECT_GT(bent, 2);
    EXPECT_LT(straight, 0.3);
}

/// Vertical offsets of blocks of the left picture that are found in the right one: where the sum of absolute
/// differences, each block less its mean, is least by far.
std::vector<int> offsets(const Picture<Gray8>& left, const Picture<Gray8>& right) {
    constexpr int half = 10;
    std::vector<int> found;
    for (int y = 60; y < 420; y += 36)
        for (int x = 200; x < 600; x += 36) {
            int least = 1 << 30, best = 0, high = 0, low = 255, sum = 0;
            for (int v = -half; v <= half; ++v)
                for (int u = -half; u <= half; ++u) {
                    high = std::max<int>(high, left.view()(x + u, y + v));
                    low = std::min<int>(low, left.view()(x + u, y + v));
                    sum += left.view()(x + u, y + v);
                }
            if (high - low < 80) continue;
            for (int dy = -10; dy <= 10; ++dy)
                for (int disparity = 60; disparity <= 170; ++disparity) {
                    if (x - disparity - half < 0) continue;
                    int other = 0;
                    for (int v = -half; v <= half; v += 2)
                        for (int u = -half; u <= half; u += 2)
                            other += right.view()(x + u - disparity, y + v + dy);
                    const int shift = sum / 441 - other / 121;
                    int off = 0;
                    for (int v = -half; v <= half && off < least; v += 2)
                        for (int u = -half; u <= half; u += 2)
                            off += std::abs(left.view()(x + u, y + v) -
                                            right.view()(x + u - disparity, y + v + dy) - shift);
                    if (off < least) {
                        least = off;
                        best = dy;
                    }
                }
            // Ten levels a pixel: the same thing, seen from the other side.
            if (least < 121 * 10) found.push_back(best);
        }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(ToolkitCameras, RowsOfTheSceneAgreeWhenRectified) {
    FOVEA_NEED_PICTURE(ivt("scene_left.bmp"));
    const CameraFile file = cameras("camera_armar_640x480.txt");
    ASSERT_TRUE(file.stereo());
    const Picture<Gray8> before[2] = {gray("scene_left.bmp"), gray("scene_right.bmp")};
    std::string problem;
    const auto pair =
        apps::rectified_pair(file, "camera", {640, 480}, RectifyOptions::Zoom::focal_length, problem);
    ASSERT_TRUE(pair.ok()) << problem;
    Picture<Gray8> after[2];
    for (std::size_t i = 0; i < 2; ++i) {
        PictureMap map;
        ASSERT_EQ(apps::make_map(LensInverse<>(file.cameras[i].camera), i == 0 ? pair->left : pair->right,
                                 pair->camera, {640, 480}, pair->size, map),
                  Status::ok);
        after[i] = warped(before[i], map);
    }
    const std::vector<int> raw = offsets(before[0], before[1]);
    const std::vector<int> rectified = offsets(after[0], after[1]);
    const auto share = [](const std::vector<int>& sorted, int percent) {
        return sorted[sorted.size() * static_cast<std::size_t>(percent) / 100];
    };
    ASSERT_GT(raw.size(), 20u);
    ASSERT_GT(rectified.size(), 20u);
    std::printf("vertical offsets, 10 %%, half and 90 %%: %d %d %d of %zu before, %d %d %d of %zu after\n",
                share(raw, 10), share(raw, 50), share(raw, 90), raw.size(), share(rectified, 10),
                share(rectified, 50), share(rectified, 90), rectified.size());
    EXPECT_GT(std::abs(share(raw, 50)), 2);
    EXPECT_GE(share(rectified, 10), -1);
    EXPECT_LE(share(rectified, 90), 1);
}

}  // namespace
}  // namespace fovea::test
