// SPDX-License-Identifier: MIT
//
// Photos of codes with their texts: how many are read at every quarter turn, that none is misread, and that
// nothing is read where there is no code.
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

#include <read/read_command.hpp>
#include <support/code_photos.hpp>

namespace fovea::test {
namespace {

using apps::ReadCode;

struct Set {
    const char* name;
    int read[4];  ///< at least so many, by quarter turns
};

/// What was read when this was written: fewer is a step back, more is news to be written down here.
class PhotosOf : public ::testing::TestWithParam<Set> {};

TEST_P(PhotosOf, AreReadAtEveryQuarterTurnAndNeverMisread) {
    const Set& set = GetParam();
    FOVEA_NEED_PICTURE(data_folder() / "codes" / set.name);
    std::vector<Photo> pictures = photos(set.name);
    ASSERT_FALSE(pictures.empty());
    for (int turn = 0; turn < 4; ++turn) {
        int read = 0;
        for (Photo& photo : pictures) {
            ASSERT_FALSE(photo.picture.size.empty()) << photo.name;
            std::vector<ReadCode> codes;
            static_cast<void>(apps::detail::read_picture(photo.picture, {}, codes));
            bool right = false;
            for (const ReadCode& code : codes) {
                const std::string text = plain(code.text);
                right = right || text == photo.text;
                // One photo shows a code inside of another one.
                const bool second = std::string(set.name) == "qrcode-2" && photo.name == "16.png";
                // The text beside another one lacks the last letter of a word; its modules are those of
                // 12.png, which has it.
                const bool same_as_12 =
                    std::string(set.name) == "qrcode-2" && photo.name == "13.png" &&
                    text == "The 2005 USGS aerial photography of the Washington Monument is censored.";
                EXPECT_TRUE(second || same_as_12 || text == photo.text)
                    << set.name << '/' << photo.name << " turned " << turn << ": " << text;
            }
            read += right ? 1 : 0;
            photo.picture = turned(photo.picture);
        }
        EXPECT_GE(read, set.read[turn]) << set.name << " turned " << turn;
        std::cout << set.name << " turned " << turn * 90 << ": " << read << " of " << pictures.size() << '\n';
    }
}

INSTANTIATE_TEST_SUITE_P(Sets, PhotosOf,
                         ::testing::Values(Set{"ean13-1", {32, 32, 32, 32}}, Set{"ean13-3", {55, 55, 55, 55}},
                                           Set{"ean13-5", {15, 15, 15, 15}}, Set{"ean8-1", {8, 8, 8, 8}},
                                           Set{"upca-1", {19, 18, 19, 18}}, Set{"upca-3", {13, 12, 13, 12}},
                                           Set{"upca-4", {12, 12, 12, 12}}, Set{"upce-1", {3, 3, 3, 3}},
                                           Set{"upce-3", {10, 10, 10, 10}}, Set{"qrcode-1", {20, 20, 20, 20}},
                                           Set{"qrcode-2", {33, 33, 33, 33}},
                                           Set{"qrcode-3", {42, 42, 42, 42}},
                                           Set{"qrcode-5", {19, 19, 19, 19}},
                                           Set{"datamatrix-1", {23, 23, 23, 23}},
                                           Set{"datamatrix-3", {18, 18, 18, 18}}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

TEST(PhotosWithoutCodes, AreSilent) {
    FOVEA_NEED_PICTURE(data_folder() / "codes" / "falsepositives");
    for (Photo& photo : photos("falsepositives")) {
        for (int turn = 0; turn < 4; ++turn) {
            std::vector<ReadCode> codes;
            static_cast<void>(apps::detail::read_picture(photo.picture, {}, codes));
            for (const ReadCode& code : codes)
                ADD_FAILURE() << photo.name << " turned " << turn << ": " << apps::human_code(code);
            photo.picture = turned(photo.picture);
        }
    }
}

}  // namespace
}  // namespace fovea::test
