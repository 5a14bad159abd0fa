// SPDX-License-Identifier: MIT
//
// Lines of the bench for operators of the catalogue, which need no code of their own but for the peer.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <fovea/catalogue/operator.hpp>

#include <bench/harness.hpp>
#include <bench/opencv.hpp>
#include <bench/pictures.hpp>
#include <op/all_operators.hpp>

namespace fovea::bench {

#if defined(FOVEA_HAVE_OPENCV)

inline int opencv_type(PixelKind kind) {
    switch (kind) {
        case PixelKind::gray16: return CV_16UC1;
        case PixelKind::gradient16: return CV_16SC1;
        case PixelKind::rgb888:
        case PixelKind::hsv888:
        case PixelKind::lab888: return CV_8UC3;
        case PixelKind::yuyv:
        case PixelKind::uyvy:
        case PixelKind::rgb565: return CV_8UC2;
        case PixelKind::sum32:
        case PixelKind::response32: return CV_32SC1;
        default: return CV_8UC1;
    }
}

/// The same work by OpenCV: from the inputs to the output, both of the pixels of the operator.
using Peer = std::function<void(const std::vector<cv::Mat>& inputs, cv::Mat& output)>;
/// A peer where OpenCV is there, nothing elsewhere: FOVEA_OPENCV(cv::erode(in[0], out, ...)). The first form
/// keeps what stands around it.
#define FOVEA_OPENCV_KEEPING(keeping, ...)                                                          \
    ::fovea::bench::Peer([keeping]([[maybe_unused]] const std::vector<cv::Mat>& in, cv::Mat& out) { \
        static_cast<void>(out);                                                                     \
        __VA_ARGS__;                                                                                \
    })
#define FOVEA_OPENCV(...) FOVEA_OPENCV_KEEPING(, __VA_ARGS__)

#else

struct Peer {};
#define FOVEA_OPENCV_KEEPING(...) ::fovea::bench::Peer()
#define FOVEA_OPENCV(...) ::fovea::bench::Peer()

#endif

/// An input as a camera gives it: the part, with a colour cast where there is colour. The second input of an
/// operator is the part seen a little later.
inline Bytes operator_picture(PixelKind kind, Size size, int number) {
    Picture<Gray8> gray = part(size);
    Bytes bytes(static_cast<std::size_t>(size.area() * bytes_of(kind)));
    const int count = bytes_of(kind);
    std::size_t at = 0;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const int level = gray.view()((x + 3 * number) % size.width, y);
            const int colours[] = {level, level * 7 / 8, 255 - level / 2, 0};
            for (int i = 0; i < count; ++i) bytes[at++] = static_cast<std::uint8_t>(colours[i]);
        }
    return bytes;
}

/// Adds the line of an operator. values are its parameters in order, presets where they end early; title is
/// what the table says, the name if empty.
inline bool add_operator(int order, const std::string& name, Sizes sizes, const std::vector<int>& values,
                         [[maybe_unused]] Peer peer, const std::string& title = "") {
    return add(order, title.empty() ? name : title, sizes, [=](Row& row) {
        const Operator* op = find_operator(apps::all_operators(), name.c_str());
        if (op == nullptr) {
            std::fprintf(stderr, "bench: no operator is called %s\n", name.c_str());
            std::exit(2);
        }
        OperatorCall& call = row.keep(OperatorCall());
        for (int i = 0; i < op->parameter_count(); ++i)
            call.values[i] = static_cast<std::size_t>(i) < values.size() ? values[static_cast<std::size_t>(i)]
                                                                         : op->parameters[i].preset;
        const auto image = [&](PixelKind kind, Size size, Bytes pixels) {
            auto& kept = row.keep(std::move(pixels));
            return AnyImage{kept.data(), size, std::ptrdiff_t{size.width} * bytes_of(kind)};
        };
        for (int i = 0; i < op->input_count(); ++i)
            call.inputs[i] = image(op->inputs[i], row.size(), operator_picture(op->inputs[i], row.size(), i));
        const Size out = op->size_for(row.size(), call.values);
        call.output = image(op->output, out, bytes(out.area() * bytes_of(op->output)));
        std::int64_t moved = out.area() * bytes_of(op->output);
        for (int i = 0; i < op->input_count(); ++i) moved += row.size().area() * bytes_of(op->inputs[i]);
        row.moves(moved);
        call.scratch = span_of(row.keep(bytes(op->scratch_for(row.size(), call.values))));
        if (const Status s = run_operator(*op, call); s != Status::ok) {
            std::fprintf(stderr, "bench: %s: %s\n", name.c_str(), describe(s));
            std::exit(2);
        }
        row.ours([&call, op] { consume(run_operator(*op, call)); });
#if defined(FOVEA_HAVE_OPENCV)
        if (peer) {
            std::vector<cv::Mat> inputs;
            for (int i = 0; i < op->input_count(); ++i)
                inputs.emplace_back(row.size().height, row.size().width, opencv_type(op->inputs[i]),
                                    call.inputs[i].first);
            cv::Mat& output = row.keep(cv::Mat(out.height, out.width, opencv_type(op->output)));
            row.peer("OpenCV", [inputs, &output, peer] { peer(inputs, output); });
        }
#endif
    });
}

}  // namespace fovea::bench
