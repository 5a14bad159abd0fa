// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/camera/packed_camera.hpp>
#include <support/random_matrix.hpp>

namespace fovea::test {
namespace {

constexpr Real Camera<>::*members[] = {&Camera<>::fx, &Camera<>::fy, &Camera<>::cx,
                                       &Camera<>::cy, &Camera<>::k1, &Camera<>::k2,
                                       &Camera<>::k3, &Camera<>::p1, &Camera<>::p2};

CameraSet random_set(Random& random, int count) {
    CameraSet set;
    set.count = count;
    for (int i = 0; i < count; ++i) {
        const int width = random.between(1, 32767);
        set.sizes[i] = {width, random.between(1, 32767)};
        for (Real Camera<>::*member : members) set.cameras[i].*member = random_part(random);
        set.cameras[i].fx = set.cameras[i].fx.absolute() + Real::from_ratio(1, 3);
        set.cameras[i].fy = set.cameras[i].fy.absolute() + Real::from_ratio(1, 7);
    }
    if (count == 2)
        set.right_from_left = {rotation_about(random_matrix<3, 1>(random)), random_matrix<3, 1>(random)};
    return set;
}

bool same(const CameraSet& a, const CameraSet& b) {
    if (a.count != b.count) return false;
    for (int i = 0; i < a.count; ++i) {
        if (a.sizes[i] != b.sizes[i]) return false;
        for (Real Camera<>::*member : members)
            if (a.cameras[i].*member != b.cameras[i].*member) return false;
    }
    return a.right_from_left.rotation == b.right_from_left.rotation &&
           a.right_from_left.translation == b.right_from_left.translation;
}

Span<const std::uint8_t> span(const std::vector<std::uint8_t>& bytes) {
    return {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())};
}
std::vector<std::uint8_t> packed(const CameraSet& set) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(packed_camera_bytes(set.count)));
    const auto size = pack_cameras(set, {bytes.data(), static_cast<std::ptrdiff_t>(bytes.size())});
    EXPECT_TRUE(size.ok());
    EXPECT_EQ(*size, static_cast<std::ptrdiff_t>(bytes.size()));
    return bytes;
}
/// With a checksum that is right again.
void sign(std::vector<std::uint8_t>& bytes) {
    const std::uint32_t sum = crc32(span(bytes).first(static_cast<std::ptrdiff_t>(bytes.size()) - 4));
    for (std::size_t i = 0; i < 4; ++i) bytes[bytes.size() - 4 + i] = static_cast<std::uint8_t>(sum >> 8 * i);
}

TEST(PackedCamera, HasTheBytesOfItsFormat) {
    // fx = 1.5 is 3 * 2^62 with exponent 0; cy = -2^-2.
    CameraSet set;
    set.sizes[0] = {640, 480};
    set.cameras[0].fx = Real::from_int(3, -1);
    set.cameras[0].cy = Real::from_int(-1, -2);
    const std::vector<std::uint8_t> bytes = packed(set);
    ASSERT_EQ(bytes.size(), 106u);
    const std::vector<std::uint8_t> begin = {'F',  'V', 'C', 'M', 1, 1, 106, 0,    0x80, 2,
                                             0xe0, 1,                                            // 640 480
                                             0,    0,   0,   0,   0, 0, 0,   0xc0, 0,    0x80,   // fx
                                             0,    0,   0,   0,   0, 0, 0,   0x80, 0,    0x80,   // fy
                                             0,    0,   0,   0,   0, 0, 0,   0,    0,    0,      // cx
                                             0,    0,   0,   0,   0, 0, 0,   0x80, 0xfd, 0x7f};  // cy
    EXPECT_EQ(
        std::vector<std::uint8_t>(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(begin.size())),
        begin);
    EXPECT_EQ(packed_camera_bytes(2), 320);
}

TEST(PackedCamera, IsTheSameWhenItIsRead) {
    Random random(9);
    for (int i = 0; i < 100; ++i) {
        const CameraSet set = random_set(random, 1 + i % 2);
        CameraSet read;
        ASSERT_EQ(unpack_cameras(span(packed(set)), read), Status::ok);
        ASSERT_TRUE(same(set, read));
    }
}

TEST(PackedCamera, RefusesEveryDisturbedByteAndEveryShorterText) {
    Random random(10);
    const CameraSet set = random_set(random, 2);
    const std::vector<std::uint8_t> bytes = packed(set);
    CameraSet read;
    const CameraSet before = read;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        std::vector<std::uint8_t> disturbed = bytes;
        disturbed[i] ^= static_cast<std::uint8_t>(1 << i % 8);
        ASSERT_NE(unpack_cameras(span(disturbed), read), Status::ok) << i;
        ASSERT_EQ(unpack_cameras(span(bytes).first(static_cast<std::ptrdiff_t>(i)), read), Status::truncated);
    }
    std::vector<std::uint8_t> longer = bytes;
    longer.push_back(0);
    EXPECT_EQ(unpack_cameras(span(longer), read), Status::malformed);
    std::vector<std::uint8_t> newer = bytes;
    newer[4] = 2;
    EXPECT_EQ(unpack_cameras(span(newer), read), Status::unsupported);
    EXPECT_TRUE(same(read, before));
}

TEST(PackedCamera, RefusesNumbersThatNoCameraHas) {
    Random random(11);
    const std::vector<std::uint8_t> good = packed(random_set(random, 2));
    CameraSet read;
    const auto with = [&](std::size_t at, std::vector<std::uint8_t> values) {
        std::vector<std::uint8_t> bytes = good;
        for (const std::uint8_t value : values) bytes[at++] = value;
        sign(bytes);
        return unpack_cameras(span(bytes), read);
    };
    EXPECT_EQ(with(8, {good[8]}), Status::ok);
    EXPECT_EQ(with(8, {0, 0}), Status::malformed);             // a width of 0 beside a height
    EXPECT_EQ(with(8, {0xff, 0xff}), Status::malformed);       // a side of 65535
    EXPECT_EQ(with(5, {3}), Status::malformed);                // three cameras
    EXPECT_EQ(with(12 + 7, {0x7f}), Status::malformed);        // a mantissa without its first bit
    EXPECT_EQ(with(12 + 8, {0xff, 0xff}), Status::malformed);  // an exponent of 16383
    EXPECT_EQ(with(12 + 8, {0, 0}), Status::malformed);        // and of -16384
    EXPECT_EQ(with(12, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0}), Status::malformed);                 // fx 0
    EXPECT_EQ(with(12 + 8, {static_cast<std::uint8_t>(good[20] ^ 1)}), Status::malformed);  // fx below 0
    EXPECT_EQ(with(196, {0, 0, 0, 0, 0, 0, 0, 0x80, 0, 0x80}), Status::malformed);          // no rotation
}

TEST(PackedCamera, RefusesToWriteSuch) {
    Random random(12);
    std::uint8_t room[320];
    const CameraSet good = random_set(random, 2);
    EXPECT_TRUE(pack_cameras(good, room).ok());
    EXPECT_EQ(pack_cameras(good, Span<std::uint8_t>(room).first(319)).status(), Status::buffer_too_small);
    const auto status = [&](const CameraSet& set) { return pack_cameras(set, room).status(); };
    for (const int count : {0, 3, -1}) {
        CameraSet set = good;
        set.count = count;
        EXPECT_EQ(status(set), Status::bad_argument);
    }
    CameraSet set = good;
    set.cameras[1].fy = Real();
    EXPECT_EQ(status(set), Status::bad_argument);
    set = good;
    set.cameras[0].k1 = Real::from_int(1, 300);
    EXPECT_EQ(status(set), Status::bad_argument);
    set = good;
    set.sizes[0] = {-1, -1};
    EXPECT_EQ(status(set), Status::bad_argument);
    set = good;
    set.right_from_left.rotation = Matrix<3, 3>();
    EXPECT_EQ(status(set), Status::bad_argument);
}

}  // namespace
}  // namespace fovea::test
