// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/code/profile_spans.hpp>

#include "support/blurred_bars.hpp"

namespace fovea {
namespace {

Span<const std::uint16_t> view(const std::vector<std::uint16_t>& profile) {
    return {profile.data(), static_cast<std::ptrdiff_t>(profile.size())};
}

TEST(FindProfileSpans, HoldTheBarsBetweenTheirQuietZones) {
    for (const double blur : {1.0, 3.0, 5.0}) {
        test::BarCamera camera;
        camera.blur = blur;
        camera.noise = 0.4;
        const std::vector<std::uint16_t> profile =
            test::bar_profile(test::ean_modules("9780905705712"), camera);
        List<ProfileSpan, 16> spans;
        ASSERT_EQ(find_profile_spans(view(profile), static_cast<int>(profile.size() / 2), spans.view()),
                  Status::ok);
        // Bars from 20 to 210; blur reaches into the margins, which have 20.
        bool found = false;
        for (const ProfileSpan& span : spans) {
            found = found || (span.left >= 2 && span.left <= 20 - blur + 2 && span.right >= 210 + blur - 2);
        }
        EXPECT_TRUE(found) << blur;
    }
}

TEST(FindProfileSpans, TellTheWidestFirstAndAsManyAsThereIsRoomFor) {
    // Tops of equal height every 20 places.
    std::vector<std::uint16_t> profile(400, 10000);
    for (std::size_t x = 10; x < 400; x += 20) profile[x] = 50000;
    List<ProfileSpan, 16> spans;
    ASSERT_EQ(find_profile_spans(view(profile), 200, spans.view()), Status::ok);
    EXPECT_EQ(spans.size(), 16);
    EXPECT_EQ(spans[0].left, 10);
    EXPECT_EQ(spans[0].right, 390);
    for (int i = 1; i < 16; ++i) {
        EXPECT_LE(spans[i].right - spans[i].left, spans[i - 1].right - spans[i - 1].left);
    }
    List<ProfileSpan, 2> few;
    EXPECT_EQ(find_profile_spans(view(profile), 200, few.view()), Status::capacity_exceeded);
    EXPECT_EQ(few[0].left, 10);
    EXPECT_EQ(few.size(), 2);
}

TEST(FindProfileSpans, SayWhatTheyCannotFind) {
    const std::vector<std::uint16_t> flat(200, 40000);
    List<ProfileSpan, 4> spans;
    EXPECT_EQ(find_profile_spans({}, 0, spans.view()), Status::empty_image);
    EXPECT_EQ(find_profile_spans(view(flat), -1, spans.view()), Status::out_of_range);
    EXPECT_EQ(find_profile_spans(view(flat), 200, spans.view()), Status::out_of_range);
    EXPECT_EQ(find_profile_spans(view(flat), 100, spans.view()), Status::not_found);
    EXPECT_EQ(spans.size(), 0);
}

}  // namespace
}  // namespace fovea
