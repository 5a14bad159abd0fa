// SPDX-License-Identifier: MIT
#include <cstddef>
#include <vector>

#include <fovea/image/bit_view.hpp>
#include <fovea/morphology/bit_morphology.hpp>
#include <fovea/morphology/distance_transform.hpp>
#include <fovea/morphology/thinning.hpp>
#include <fovea/pixelwise/bits.hpp>
#include <fovea/pixelwise/threshold.hpp>

#include <bench/operators.hpp>

namespace fovea::bench {
namespace {

/// OpenCV's operations by number, with a rectangle.
[[maybe_unused]] constexpr int erosion = 0, dilation = 1, opened = 2, closed = 3, rim = 4, top = 5, black = 6;

Peer rectangle([[maybe_unused]] int operation, [[maybe_unused]] int side) {
    return FOVEA_OPENCV_KEEPING(
        =, cv::morphologyEx(in[0], out, operation, cv::getStructuringElement(cv::MORPH_RECT, {side, side})));
}

Peer ellipse([[maybe_unused]] int operation, [[maybe_unused]] int side) {
    return FOVEA_OPENCV_KEEPING(
        =,
        cv::morphologyEx(in[0], out, operation, cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side})));
}
Peer cross([[maybe_unused]] int operation, [[maybe_unused]] int side) {
    return FOVEA_OPENCV_KEEPING(
        =, cv::morphologyEx(in[0], out, operation, cv::getStructuringElement(cv::MORPH_CROSS, {side, side})));
}

/// Of the dark part; imgproc has nothing like it.
template <class Pixel, class Transform>
bool add_distance(int order, const char* title, std::int64_t (*scratch_of)(Size), Transform transform,
                  [[maybe_unused]] int mask) {
    return add(order, title, Sizes::vga_and_full_hd, [=](Row& row) {
        auto& src = row.keep(part(row.size()));
        consume(threshold_inverse(src.view(), 128, src.view()));
        auto& dst = row.keep(Picture<Pixel>(row.size()));
        auto& scratch = row.keep(bytes(scratch_of(row.size())));
        row.ours([&src, &dst, &scratch, transform] {
            consume(transform(src.view(), span_of(scratch), dst.view()));
        });
#if defined(FOVEA_HAVE_OPENCV)
        row.peer("OpenCV", [a = mat(src), mask, far = cv::Mat()]() mutable {
            cv::distanceTransform(a, far, cv::DIST_L2, mask);
        });
#endif
    });
}

bool add_thinning(int order, ThinningRule rule, const char* title) {
    return add(order, title, Sizes::vga, [rule](Row& row) {
        auto& src = row.keep(part(row.size()));
        consume(threshold_inverse(src.view(), 128, src.view()));
        auto& dst = row.keep(Picture<Gray8>(row.size()));
        auto& scratch = row.keep(bytes(thin_scratch(row.size())));
        row.ours([&src, &dst, &scratch, rule] {
            consume(thin(src.view(), rule, most_thinning_passes, span_of(scratch), dst.view()));
        });
    });
}

/// An image of bits, and another one for the result.
struct BitPictures {
    std::vector<BitWord> words;
    Size size;

    explicit BitPictures(Size of)
        : words(2 * static_cast<std::size_t>(bit_words(of.width) * of.height)), size(of) {}
    BitView<BitWord> view(int number) {
        const std::ptrdiff_t stride = bit_words(size.width);
        return {words.data() + number * stride * size.height, size, stride};
    }
};

/// A bit a pixel against OpenCV's byte a pixel.
template <class Run>
bool add_bits(int order, const char* title, Run run, [[maybe_unused]] Peer peer) {
    return add(order, title, Sizes::vga_and_full_hd, [=](Row& row) {
        auto& src = row.keep(blobs(row.size()));
        auto& dst = row.keep(Picture<Gray8>(row.size()));
        auto& bits = row.keep(BitPictures(row.size()));
        auto& scratch =
            row.keep(std::vector<BitWord>(static_cast<std::size_t>(bit_erode_scratch(row.size()))));
        consume(pack_bits(src.view(), bits.view(0)));
        row.ours([&, run] {
            const Span<BitWord> room(scratch.data(), static_cast<std::ptrdiff_t>(scratch.size()));
            consume(run(src.view(), bits, room, dst.view()));
        });
#if defined(FOVEA_HAVE_OPENCV)
        if (peer)
            row.peer("OpenCV", [peer, in = std::vector<cv::Mat>{mat(src)}, out = mat(dst)]() mutable {
                peer(in, out);
            });
#endif
    });
}

using Gray = ImageView<Gray8>;

const bool bit_lines[] = {
    add_bits(
        1820, "pack_bits",
        [](Gray src, BitPictures& bits, Span<BitWord>, Gray) { return pack_bits(src, 128, bits.view(1)); },
        FOVEA_OPENCV(cv::threshold(in[0], out, 127, 255, cv::THRESH_BINARY))),
    add_bits(
        1821, "unpack_bits",
        [](Gray, BitPictures& bits, Span<BitWord>, Gray dst) { return unpack_bits(bits.view(0), dst); },
        Peer()),
    add_bits(
        1822, "erode 3x3, bits",
        [](Gray, BitPictures& bits, Span<BitWord> scratch, Gray) {
            return erode(bits.view(0), {3, 3}, scratch, bits.view(1));
        },
        rectangle(erosion, 3)),
    add_bits(
        1823, "dilate 15x15, bits",
        [](Gray, BitPictures& bits, Span<BitWord> scratch, Gray) {
            return dilate(bits.view(0), {15, 15}, scratch, bits.view(1));
        },
        rectangle(dilation, 15)),
};

const bool lines[] = {
    add_operator(30, "erode", Sizes::vga_and_full_hd, {3, 3}, rectangle(erosion, 3), "erode 3x3"),
    add_operator(31, "erode", Sizes::vga_and_full_hd, {15, 15}, rectangle(erosion, 15), "erode 15x15"),
    add_operator(32, "dilate", Sizes::vga, {3, 3}, rectangle(dilation, 3), "dilate 3x3"),
    add_operator(33, "opening", Sizes::vga_and_full_hd, {3, 3}, rectangle(opened, 3), "opening 3x3"),
    add_operator(1800, "top_hat", Sizes::vga_and_full_hd, {15, 15}, rectangle(top, 15), "top_hat 15x15"),
    add_operator(1801, "black_hat", Sizes::vga, {3, 3}, rectangle(black, 3), "black_hat 3x3"),
    add_operator(1802, "morphological_gradient", Sizes::vga_and_full_hd, {3, 3}, rectangle(rim, 3),
                 "morphological_gradient 3x3"),
    add_operator(1803, "erode_shape", Sizes::vga_and_full_hd, {1, 15}, ellipse(erosion, 15),
                 "erode, disc of 15"),
    add_operator(1804, "erode_shape", Sizes::vga, {0, 3}, cross(erosion, 3), "erode, cross of 3"),
    add_operator(1807, "dilate_shape", Sizes::vga, {0, 15}, cross(dilation, 15), "dilate, cross of 15"),
    add_operator(1808, "opening_shape", Sizes::vga, {1, 7}, ellipse(opened, 7), "opening, disc of 7"),
    add_operator(1810, "hit_or_miss", Sizes::vga, {1}, FOVEA_OPENCV({
                     const cv::Mat corner = (cv::Mat_<int>(3, 3) << -1, -1, 0, -1, 1, 1, 0, 1, 0);
                     cv::morphologyEx(in[0], out, cv::MORPH_HITMISS, corner);
                 })),
    add_operator(1809, "closing_shape", Sizes::vga, {1, 7}, ellipse(closed, 7), "closing, disc of 7"),
    add_thinning(1810, ThinningRule::zhang_suen, "thin, Zhang and Suen, one part"),
    add_thinning(1811, ThinningRule::guo_hall, "thin, Guo and Hall, one part"),
    add_distance<Sum32>(1805, "squared_distance, one part", squared_distance_scratch, squared_distance, 0),
    add_distance<Gray16>(1806, "chamfer_distance, one part", chamfer_distance_scratch, chamfer_distance, 3),
    add_operator(34, "closing", Sizes::vga, {3, 3}, rectangle(closed, 3), "closing 3x3"),
};

}  // namespace
}  // namespace fovea::bench
