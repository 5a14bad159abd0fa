// SPDX-License-Identifier: MIT
//
// Operator: an entry of the catalogue, which lists every operator from images to an image in one form. The
// command line, the golden vectors, the fuzz program, the bench and the pages of docs all read it.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// What the pixels of an operator's images are.
enum class PixelKind : std::uint8_t {
    none,
    gray8,
    gray16,
    gradient16,
    rgb888,
    hsv888,
    lab888,
    yuyv,
    uyvy,
    rgb565,
    sum32,
    response32,
};

/// Bytes of one pixel.
constexpr int bytes_of(PixelKind kind);

/// Lower-case name of a pixel kind.
constexpr const char* describe(PixelKind kind);

/// A parameter of an operator. Allowed are least, least + step, ... up to most.
struct OperatorParameter {
    const char* name = nullptr;
    int least = 0;
    int most = 0;
    int preset = 0;
    int step = 1;
    const char* text = "";          ///< unit and meaning, one line
    const char* choices = nullptr;  ///< for names instead of numbers: "replicate|reflect_101", from 0 on
    bool follows = false;           ///< where nobody gives it, it is what the one before it is

    constexpr bool allows(int value) const {
        return value >= least && value <= most && (value - least) % step == 0;
    }
};

/// An image whose pixel is known when the program runs.
struct AnyImage {
    void* first = nullptr;
    Size size;
    std::ptrdiff_t stride_bytes = 0;
};

inline constexpr int max_operator_inputs = 2;
inline constexpr int max_operator_parameters = 12;

/// What an operator works on: images of its entry's kinds, its parameters' values in order.
struct OperatorCall {
    AnyImage inputs[max_operator_inputs];
    int values[max_operator_parameters] = {};
    Span<std::uint8_t> scratch;
    AnyImage output;

    /// An input as a view; Pixel must be what the entry says.
    template <class Pixel>
    ImageView<const Pixel> input(int number = 0) const {
        const AnyImage& image = inputs[number];
        return {static_cast<const Pixel*>(image.first), image.size, image.stride_bytes};
    }
    template <class Pixel>
    ImageView<Pixel> out() const {
        return {static_cast<Pixel*>(output.first), output.size, output.stride_bytes};
    }
    Gray8 level(int number) const { return static_cast<Gray8>(values[number]); }
};

/// An entry of the catalogue.
struct Operator {
    const char* name;
    const char* summary;  ///< one line, lower case
    const char* book;     ///< section or equation; empty if the book does not have it
    PixelKind inputs[max_operator_inputs];
    PixelKind output;
    OperatorParameter parameters[max_operator_parameters];
    /// Size of the output for the first input and the parameters; as large as the first input where null. An
    /// empty size means that no output fits (bad_argument).
    Size (*output_size)(Size input, const int* values);
    /// Bytes of scratch; none where null. Of the first input's size.
    std::int64_t (*scratch)(Size input, const int* values);
    Status (*run)(const OperatorCall& call);
    bool in_place = false;        ///< the output may be the first input
    const char* alias = nullptr;  ///< a shorter name, where people know one
    Status refuses = Status::ok;  ///< what it says to images that it has no answer for, the output untouched

    constexpr int input_count() const { return inputs[1] == PixelKind::none ? 1 : 2; }
    constexpr int parameter_count() const {
        int count = 0;
        while (count < max_operator_parameters && parameters[count].name != nullptr) ++count;
        return count;
    }
    constexpr Size size_for(Size input, const int* values) const {
        return output_size == nullptr ? input : output_size(input, values);
    }
    constexpr std::int64_t scratch_for(Size input, const int* values) const {
        return scratch == nullptr ? 0 : scratch(input, values);
    }
};

/// A folder of the core and its operators.
struct OperatorFamily {
    const char* name;
    Span<const Operator> operators;
};

/// The operator of a name or an alias among families; null if there is none.
constexpr const Operator* find_operator(Span<const OperatorFamily> families, const char* name);

/// Runs an operator after its entry's checks: parameters in their range, all views there and of fitting size,
/// scratch enough.
///
/// Errors  empty_image, image_too_large above max_image_side, size_mismatch, bad_argument, scratch_too_small,
///         and what the operator answers
inline Status run_operator(const Operator& op, const OperatorCall& call);

// ---- Implementation ---------------------------------------------------------------

constexpr int bytes_of(PixelKind kind) {
    switch (kind) {
        case PixelKind::none: return 0;
        case PixelKind::gray8: return sizeof(Gray8);
        case PixelKind::gray16: return sizeof(Gray16);
        case PixelKind::gradient16: return sizeof(Gradient16);
        case PixelKind::rgb888: return sizeof(Rgb888);
        case PixelKind::hsv888: return sizeof(Hsv888);
        case PixelKind::lab888: return sizeof(Lab888);
        case PixelKind::yuyv: return sizeof(Yuyv);
        case PixelKind::uyvy: return sizeof(Uyvy);
        case PixelKind::rgb565: return sizeof(Rgb565);
        case PixelKind::sum32: return sizeof(Sum32);
        case PixelKind::response32: return sizeof(Response32);
    }
    return 0;
}

constexpr const char* describe(PixelKind kind) {
    switch (kind) {
        case PixelKind::none: return "none";
        case PixelKind::gray8: return "gray8";
        case PixelKind::gray16: return "gray16";
        case PixelKind::gradient16: return "gradient16";
        case PixelKind::rgb888: return "rgb888";
        case PixelKind::hsv888: return "hsv888";
        case PixelKind::lab888: return "lab888";
        case PixelKind::yuyv: return "yuyv";
        case PixelKind::uyvy: return "uyvy";
        case PixelKind::rgb565: return "rgb565";
        case PixelKind::sum32: return "sum32";
        case PixelKind::response32: return "response32";
    }
    return "unknown";
}

constexpr const Operator* find_operator(Span<const OperatorFamily> families, const char* name) {
    const auto is_name = [name](const char* a) {
        const char* b = name;
        while (*a != '\0' && *a == *b) {
            ++a;
            ++b;
        }
        return *a == *b;
    };
    for (const OperatorFamily& family : families)
        for (const Operator& op : family.operators)
            if (is_name(op.name) || (op.alias != nullptr && is_name(op.alias))) return &op;
    return nullptr;
}

inline Status run_operator(const Operator& op, const OperatorCall& call) {
    for (int i = 0; i < op.input_count(); ++i) {
        if (call.inputs[i].size.empty()) return Status::empty_image;
        if (call.inputs[i].size.width > max_image_side || call.inputs[i].size.height > max_image_side)
            return Status::image_too_large;
    }
    if (op.input_count() == 2 && call.inputs[1].size != call.inputs[0].size) return Status::size_mismatch;
    for (int i = 0; i < op.parameter_count(); ++i)
        if (!op.parameters[i].allows(call.values[i])) return Status::bad_argument;
    const Size size = op.size_for(call.inputs[0].size, call.values);
    if (size.empty()) return Status::bad_argument;
    if (call.output.size != size) return Status::size_mismatch;
    if (call.scratch.size() < op.scratch_for(call.inputs[0].size, call.values))
        return Status::scratch_too_small;
    return op.run(call);
}

}  // namespace fovea
