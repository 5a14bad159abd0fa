// SPDX-License-Identifier: MIT
//
// What every filter of one border parameter is tried on. Host tests only.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/image_view.hpp>
#include <support/guarded_image.hpp>
#include <support/naive_reference.hpp>

namespace fovea::test {

inline constexpr Border all_borders[] = {Border::replicate, Border::reflect_101, Border::zero};

/// Runs filter(src, border, scratch, dst) with exactly the scratch that it asks for.
template <class Filter, class Pixel>
void run_filter(Filter filter, std::int64_t scratch_bytes, const GuardedImage<Gray8>& src, Border border,
                GuardedImage<Pixel>& dst) {
    std::vector<std::uint8_t> scratch(static_cast<std::size_t>(scratch_bytes), 0xee);
    ASSERT_EQ(
        filter(src.view(), border, {scratch.data(), static_cast<std::ptrdiff_t>(scratch.size())}, dst.view()),
        Status::ok);
}

/// Compares a filter with expected(src, border, x, y) on every size and border: random, extreme, checkered.
template <class Pixel, class Filter, class Expected>
void expect_filter(Filter filter, std::int64_t (*scratch)(Size), Expected expected) {
    Random random(41);
    for (const Size size : test_sizes())
        for (const Border border : all_borders)
            for (const int filling : {0, 1, 2, 3}) {
                GuardedImage<Gray8> src(size);
                GuardedImage<Pixel> dst(size);
                src.fill(random);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        if (filling > 0)
                            src(x, y) = filling == 1 || (filling == 2 && (x + y) % 2 == 0) ? 255 : 0;
                run_filter(filter, scratch(size), src, border, dst);
                for (int y = 0; y < size.height; ++y)
                    for (int x = 0; x < size.width; ++x)
                        ASSERT_EQ(int{dst(x, y)}, int{expected(src.view(), border, x, y)})
                            << size.width << "x" << size.height << " border " << static_cast<int>(border)
                            << " at " << x << "," << y;
            }
}

}  // namespace fovea::test
