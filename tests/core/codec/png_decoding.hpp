// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <fovea/codec/png_reader.hpp>
#include <support/guarded_image.hpp>

#include "lossless_files.hpp"

namespace fovea::test {

/// Decodes with exactly the scratch that the file asks for, at an odd address.
template <class Pixel>
Status decode_with_scratch(const Bytes& file, ImageView<Pixel> dst) {
    const Result<PictureInfo> info = inspect_png(view_of(file));
    Bytes scratch(static_cast<std::size_t>(info ? info->scratch_bytes : 0) + 1, 0xa5);
    return decode_png(view_of(file), room_in(scratch).from(1), dst);
}

template <class Pixel>
GuardedImage<Pixel> decoded_png(const Bytes& file, Size size) {
    GuardedImage<Pixel> dst(size);
    EXPECT_EQ(decode_with_scratch(file, dst.view()), Status::ok);
    return dst;
}

/// The status of a file that must leave the output as it was.
inline Status png_refusal(const Bytes& file, Size size = {1, 1}) {
    GuardedImage<Gray8> dst(size);
    fill_bytes(dst.view(), 77);
    const Status status = decode_with_scratch(file, dst.view());
    EXPECT_TRUE(all_bytes_are(dst.view(), 77)) << describe(status);
    return status;
}

}  // namespace fovea::test
