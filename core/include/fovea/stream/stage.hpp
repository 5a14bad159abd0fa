// SPDX-License-Identifier: MIT
//
// Stages: what a stream is composed of. A stage is a small value that says what it does and what memory it
// wants; stream() makes the moving parts of it.
//
// A window stage makes a row from the rows around it:
//     using Input, Output;  using Kernel;              a row kernel (image/row_kernel.hpp)
//     int rows() const;                                height of its window, odd
//     std::int64_t scratch(int width) const;           bytes that a kernel wants
//     Kernel kernel(Border, Span<std::uint8_t> scratch, int width) const;
//     Border border(Border stream) const;              only where it is not that of the stream
//     int outside() const;                             only where rows beyond a zero border hold another byte
//     bool valid() const;                              only where some parameters make no kernel
// A point stage has a window of one row, and a function in place of the kernel:
//     using Input, Output;
//     void row(const Input* src, int width, Output* dst) const;         dst may be src where both are the
//     void row(const Input* src, int width, int y, Output* dst) const;  same pixel
//     Status begin(Size size) const;                   only where it does not take every image
//     bool valid() const;                              as above
// A composite stage is two others, one after the other:
//     First first() const;
//     Second second() const;
// A joined stage makes a row of what its own stages make and of the same row of its source:
//     using Input, Made, Output;                       Made is what comes out of inside()
//     Inside inside() const;                           a window, point or composite stage
//     int kept() const;                                rows of the source that are in use at a time: one more
//                                                      than the rows that inside() looks ahead, and not less
//                                                      than its first window; up to max_window_rows
//     void join(const Input* src, const Made* made, int width, Output* dst) const;
//     bool valid() const;                              as above
// An accumulator takes rows from top to bottom, at the end of a stream or, as tap(accumulator), on the way:
//     using Input;
//     Status begin(Size size);                         of the whole image; refuses what it cannot take
//     void add_row(const Input* row, int width, int y);
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/filter_row.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/simd/isa.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

inline namespace FOVEA_ISA {

/// The window stage of a filter of image/filter_row.hpp.
template <class Filter>
struct FilterStage {
    using Kernel = FilterRow<Filter>;
    using Input = typename Kernel::Input;
    using Output = typename Kernel::Output;

    Filter filter{};

    static constexpr int rows() { return Filter::rows; }
    static constexpr std::int64_t scratch(int width) { return Kernel::scratch(width); }
    Kernel kernel(Border border, Span<std::uint8_t> bytes, int width) const {
        return Kernel(filter, border, bytes, width);
    }
};

}  // namespace FOVEA_ISA

/// Accumulator that writes the rows into an image. A strip of a frame writes its rows alone.
template <class Pixel>
class IntoImage {
public:
    using Input = Pixel;
    explicit constexpr IntoImage(ImageView<Pixel> image) : image_(image) {}

    Status begin(Size size) const { return image_.size() == size ? Status::ok : Status::size_mismatch; }
    void add_row(const Pixel* row, int width, int y) const {
        std::memcpy(image_.row(y), row, sizeof(Pixel) * static_cast<std::size_t>(width));
    }
    /// Where row y is to stand: it need not be copied then.
    Pixel* place(int y) const { return image_.row(y); }

private:
    ImageView<Pixel> image_;
};
template <class Pixel>
constexpr IntoImage<Pixel> into(ImageView<Pixel> image) {
    return IntoImage<Pixel>(image);
}

/// Accumulator that hands rows on to another one, which outlives the stream.
template <class Accumulator>
class IntoAccumulator {
public:
    using Input = typename Accumulator::Input;
    explicit constexpr IntoAccumulator(Accumulator& accumulator) : accumulator_(&accumulator) {}

    Status begin(Size size) const { return accumulator_->begin(size); }
    void add_row(const Input* row, int width, int y) const { accumulator_->add_row(row, width, y); }

private:
    Accumulator* accumulator_;
};
template <class Accumulator>
constexpr IntoAccumulator<Accumulator> into(Accumulator& accumulator) {
    return IntoAccumulator<Accumulator>(accumulator);
}

/// A stage that shows the rows that pass it to an accumulator and changes nothing.
template <class Accumulator>
struct Tap {
    using Input = typename Accumulator::Input;
    using Output = Input;
    Accumulator accumulator;
};
template <class Pixel>
constexpr Tap<IntoImage<Pixel>> tap(ImageView<Pixel> image) {
    return {into(image)};
}
template <class Accumulator>
constexpr Tap<IntoAccumulator<Accumulator>> tap(Accumulator& accumulator) {
    return {into(accumulator)};
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class Stage, class = void>
inline constexpr bool is_window_stage_v = false;
template <class Stage>
inline constexpr bool is_window_stage_v<Stage, std::void_t<typename Stage::Kernel>> = true;

template <class Stage, class = void>
inline constexpr bool has_border_v = false;
template <class Stage>
inline constexpr bool
    has_border_v<Stage, std::void_t<decltype(std::declval<const Stage&>().border(Border::replicate))>> = true;

template <class Stage, class = void>
inline constexpr bool has_valid_v = false;
template <class Stage>
inline constexpr bool has_valid_v<Stage, std::void_t<decltype(std::declval<const Stage&>().valid())>> = true;

template <class Stage, class = void>
inline constexpr bool has_outside_v = false;
template <class Stage>
inline constexpr bool has_outside_v<Stage, std::void_t<decltype(std::declval<const Stage&>().outside())>> =
    true;

template <class Stage, class = void>
inline constexpr bool has_begin_v = false;
template <class Stage>
inline constexpr bool has_begin_v<Stage, std::void_t<decltype(std::declval<const Stage&>().begin(Size()))>> =
    true;

template <class Stage, class = void>
inline constexpr bool has_row_number_v = false;
template <class Stage>
inline constexpr bool has_row_number_v<Stage, std::void_t<decltype(std::declval<const Stage&>().row(
                                                  static_cast<const typename Stage::Input*>(nullptr), 0, 0,
                                                  static_cast<typename Stage::Output*>(nullptr)))>> = true;

template <class Stage, class = void>
inline constexpr bool is_composite_v = false;
template <class Stage>
inline constexpr bool is_composite_v<Stage, std::void_t<decltype(std::declval<const Stage&>().second())>> =
    true;

template <class Stage, class = void>
inline constexpr bool is_joined_v = false;
template <class Stage>
inline constexpr bool is_joined_v<Stage, std::void_t<decltype(std::declval<const Stage&>().inside())>> = true;

template <class Stage>
inline constexpr bool is_tap_v = false;
template <class Accumulator>
inline constexpr bool is_tap_v<Tap<Accumulator>> = true;

template <class Stage, class = void>
inline constexpr bool is_accumulator_v = false;
template <class Stage>
inline constexpr bool
    is_accumulator_v<Stage, std::void_t<decltype(std::declval<Stage&>().add_row(
                                static_cast<const typename Stage::Input*>(nullptr), 0, 0))>> = true;

template <class Accumulator, class = void>
inline constexpr bool has_place_v = false;
template <class Accumulator>
inline constexpr bool has_place_v<Accumulator, std::void_t<decltype(std::declval<Accumulator&>().place(0))>> =
    true;

}  // namespace detail

}  // namespace fovea
