// SPDX-License-Identifier: MIT
#include <fovea/camera/align_points.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <support/object_scene.hpp>

namespace fovea::test {
namespace {

std::vector<Vector<3>> random_cloud(Random& random, int count) {
    std::vector<Vector<3>> points;
    for (int i = 0; i < count; ++i) points.push_back(random_matrix<3, 1>(random) * Real::from_int(100));
    return points;
}
std::vector<Vector<3>> mapped(const std::vector<Vector<3>>& points, const Pose<>& pose, Real size) {
    std::vector<Vector<3>> result;
    for (const Vector<3>& point : points) result.push_back(pose.rotation * point * size + pose.translation);
    return result;
}
double sum_of_squares(const std::vector<Vector<3>>& from, const std::vector<Vector<3>>& to,
                      const Alignment<>& map) {
    double sum = 0;
    for (std::size_t i = 0; i < from.size(); ++i)
        sum += plain(dot(map(from[i]) - to[i], map(from[i]) - to[i]));
    return sum;
}

TEST(AlignPoints, FindsTheMotionOfExactPoints) {
    Random random(91);
    for (int i = 0; i < 40; ++i) {
        auto from = random_cloud(random, 3 + i);
        // Some of them flat, and far from the origin.
        for (Vector<3>& point : from) {
            if (i % 4 == 0) point[2] = point[0];
            point[1] += Real::from_int(i % 3 == 0 ? 1000000 : 0);
        }
        const Pose<> pose = random_pose(random, 500);
        const auto found = align_points(span_of(from), span_of(mapped(from, pose, Real::one())));
        ASSERT_TRUE(found) << i;
        ASSERT_LE((exponent_of_difference<3, 3>(found->pose.rotation, pose.rotation)), -38) << i;
        ASSERT_LE(plain(found->rms), 1e-11) << i;
        ASSERT_EQ(found->size, Real::one());
        const Real size = real_of(0.01 + i);
        const auto sized = align_points_with_size(span_of(from), span_of(mapped(from, pose, size)));
        ASSERT_TRUE(sized) << i;
        ASSERT_NEAR(plain(sized->size) / plain(size), 1, 1e-12) << i;
        ASSERT_LE(plain(sized->rms), 1e-10) << i;
    }
}

TEST(AlignPoints, QuarterTurnByHand) {
    const std::vector<Vector<3>> from = {vector_of({0, 0, 0}), vector_of({2, 0, 0}), vector_of({0, 4, 0})};
    const std::vector<Vector<3>> to = {vector_of({1, 1, 5}), vector_of({1, 5, 5}), vector_of({-7, 1, 5})};
    const auto found = align_points_with_size(span_of(from), span_of(to));
    ASSERT_TRUE(found);
    EXPECT_NEAR(plain(found->size), 2, 1e-15);
    EXPECT_NEAR(plain(found->pose.rotation(1, 0)), 1, 1e-15);
    EXPECT_NEAR(plain(found->pose.rotation(0, 1)), -1, 1e-15);
    EXPECT_NEAR(plain(found->pose.rotation(2, 2)), 1, 1e-15);
    EXPECT_NEAR(plain(found->pose.translation[0]), 1, 1e-14);
    EXPECT_NEAR(plain(found->pose.translation[2]), 5, 1e-14);
    // Without the size every point is off by what is left of 2 about the mean.
    const auto rigid = align_points(span_of(from), span_of(to));
    ASSERT_TRUE(rigid);
    const double squares = (4.0 / 9 + 16.0 / 9) + (16.0 / 9 + 16.0 / 9) + (4.0 / 9 + 64.0 / 9);
    EXPECT_NEAR(plain(rigid->rms), std::sqrt(squares / 3), 1e-14);
}

TEST(AlignPoints, NoMotionNearbyIsBetter) {
    Random random(92);
    for (int i = 0; i < 10; ++i) {
        const auto from = random_cloud(random, 12);
        auto to = mapped(from, random_pose(random, 500), real_of(1.7));
        // With noise; the last third mirrored, so that the nearest rotation is far from good.
        for (Vector<3>& point : to) point += random_matrix<3, 1>(random) * Real::from_int(5);
        for (std::size_t k = i > 5 ? 0 : 12; k < 12; ++k) to[k][2] = -to[k][2];
        const auto found = align_points_with_size(span_of(from), span_of(to));
        ASSERT_TRUE(found);
        ASSERT_GT(plain(determinant(found->pose.rotation)), 0.999);
        const double least = sum_of_squares(from, to, *found);
        ASSERT_NEAR(std::sqrt(least / 12), plain(found->rms), 1e-12);
        for (int k = 0; k < 7; ++k) {
            for (const double by : {-1e-3, 1e-3}) {
                Alignment<> other = *found;
                Vector<3> axis;
                if (k < 3) axis[k] = real_of(by);
                other.pose.rotation = rotation_about(axis) * other.pose.rotation;
                if (k >= 3 && k < 6) other.pose.translation[k - 3] += real_of(by);
                if (k == 6) other.size += real_of(by);
                ASSERT_GT(sum_of_squares(from, to, other), least) << k;
            }
        }
    }
}

TEST(AlignPoints, RefusesByName) {
    Random random(93);
    auto from = random_cloud(random, 6);
    auto to = random_cloud(random, 6);
    const auto status = [&] { return align_points(span_of(from), span_of(to)).status(); };
    EXPECT_EQ(status(), Status::ok);
    EXPECT_EQ(align_points(span_of(from).first(2), span_of(to).first(2)).status(), Status::bad_argument);
    EXPECT_EQ(align_points(span_of(from).first(3), span_of(to)).status(), Status::size_mismatch);
    EXPECT_EQ(align_points(Span<const Vector<3>>(), Span<const Vector<3>>()).status(), Status::bad_argument);
    const auto line = [&](std::vector<Vector<3>>& points) {
        for (Vector<3>& point : points) point = Vector<3>(point[0], point[0] * real_of(0.3), point[0]);
    };
    line(to);
    EXPECT_EQ(status(), Status::degenerate);
    to = from;
    line(from);
    EXPECT_EQ(status(), Status::degenerate);
    // A line that is crooked by a millionth of its length.
    for (Vector<3>& point : from) point += random_matrix<3, 1>(random) * Real::from_ratio(1, 10000);
    to = from;
    EXPECT_EQ(status(), Status::degenerate);
    from.assign(6, vector_of({1, 2, 3}));
    EXPECT_EQ(status(), Status::degenerate);
    // A mirrored octahedron: many rotations are equally near.
    from = {vector_of({1, 0, 0}),  vector_of({-1, 0, 0}), vector_of({0, 1, 0}),
            vector_of({0, -1, 0}), vector_of({0, 0, 1}),  vector_of({0, 0, -1})};
    to = mapped(from, Pose<>(), -Real::one());
    EXPECT_EQ(status(), Status::degenerate);
}

}  // namespace
}  // namespace fovea::test
