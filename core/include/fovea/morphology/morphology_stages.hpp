// SPDX-License-Identifier: MIT
//
// Morphology as stages of a stream: erosion, dilation, opening and closing with a rectangle or an element of
// any shape, their differences, and the outline.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/morphology/morphology.hpp>
#include <fovea/morphology/shaped_morphology.hpp>
#include <fovea/morphology/structuring_element.hpp>
#include <fovea/morphology/top_hat.hpp>
#include <fovea/simd/isa.hpp>
#include <fovea/simd/lines.hpp>

namespace fovea {
inline namespace FOVEA_ISA {

namespace kernels {

/// The row kernel of morphological_gradient().
class GradientRow {
public:
    using Input = Gray8;
    using Output = Gray8;

    /// That of both, and a row of the erosion.
    static constexpr std::int64_t scratch(Size element, int width) {
        return 2 * ExtremeRow<Lowest>::scratch(element, width) + std::int64_t{width};
    }

    GradientRow() = default;
    GradientRow(Size element, Span<std::uint8_t> bytes, int width)
        : lowest_(element, bytes, width),
          highest_(element, bytes.from(part(element, width)), width),
          eroded_(bytes.data() + 2 * part(element, width)) {}

    int rows() const { return lowest_.rows(); }

    void operator()(const RowWindow<Gray8>& window, bool follows, Gray8* dst) {
        lowest_(window, follows, eroded_);
        highest_(window, follows, dst);
        difference_row(dst, eroded_, window.width(), dst);
    }

private:
    static constexpr std::ptrdiff_t part(Size element, int width) {
        return static_cast<std::ptrdiff_t>(ExtremeRow<Lowest>::scratch(element, width));
    }

    ExtremeRow<Lowest> lowest_;
    ExtremeRow<Highest> highest_;
    Gray8* eroded_ = nullptr;
};

}  // namespace kernels

namespace stages {

// ---- With a rectangle -------------------------------------------------------------

/// The extreme under an element, odd by odd, 1x1 to 63x63. The outermost pixels repeat whatever the stream's
/// border is, as in erode() and dilate().
template <class Extreme>
struct ExtremeStage {
    using Kernel = kernels::ExtremeRow<Extreme>;
    using Input = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_rectangle(element); }
    constexpr int rows() const { return element.height; }
    constexpr std::int64_t scratch(int width) const { return Kernel::scratch(element, width); }
    static constexpr Border border(Border) { return Border::replicate; }
    Kernel kernel(Border, Span<std::uint8_t> bytes, int width) const { return Kernel(element, bytes, width); }
};
using erode = ExtremeStage<kernels::Lowest>;
using dilate = ExtremeStage<kernels::Highest>;

/// Two of them: opening() and closing().
struct opening {
    Size element;
    constexpr erode first() const { return {element}; }
    constexpr dilate second() const { return {element}; }
};
struct closing {
    Size element;
    constexpr dilate first() const { return {element}; }
    constexpr erode second() const { return {element}; }
};

/// morphological_gradient(): the dilation less the erosion.
struct morphological_gradient {
    using Kernel = kernels::GradientRow;
    using Input = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_rectangle(element); }
    constexpr int rows() const { return element.height; }
    constexpr std::int64_t scratch(int width) const { return Kernel::scratch(element, width); }
    static constexpr Border border(Border) { return Border::replicate; }
    Kernel kernel(Border, Span<std::uint8_t> bytes, int width) const { return Kernel(element, bytes, width); }
};

/// top_hat() and black_hat(): what an opening or a closing removes.
struct top_hat {
    using Input = Gray8;
    using Made = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_rectangle(element); }
    constexpr opening inside() const { return {element}; }
    /// The opening looks half the element ahead, twice.
    constexpr int kept() const { return element.height; }
    static void join(const Gray8* src, const Gray8* opened, int width, Gray8* dst) {
        kernels::difference_row(src, opened, width, dst);
    }
};
struct black_hat {
    using Input = Gray8;
    using Made = Gray8;
    using Output = Gray8;
    Size element;

    constexpr bool valid() const { return kernels::is_rectangle(element); }
    constexpr closing inside() const { return {element}; }
    constexpr int kept() const { return element.height; }
    static void join(const Gray8* src, const Gray8* closed, int width, Gray8* dst) {
        kernels::difference_row(closed, src, width, dst);
    }
};

// ---- With an element of any shape -------------------------------------------------

/// The extreme in the places of an element. Only pixels of the image count whatever the stream's border is,
/// as in erode() and dilate() with an element.
template <class Extreme>
struct ShapedStage {
    using Kernel = kernels::ShapedRow<Extreme>;
    using Input = Gray8;
    using Output = Gray8;
    StructuringElement element;

    constexpr bool valid() const { return !element.empty(); }
    constexpr int rows() const { return element.size().height; }
    constexpr std::int64_t scratch(int width) const { return erode_scratch({width, 1}, element); }
    static constexpr Border border(Border) { return Border::zero; }
    static constexpr int outside() { return Extreme::neutral; }
    Kernel kernel(Border, Span<std::uint8_t> bytes, int width) const { return Kernel(element, bytes, width); }
};
struct erode_shaped : ShapedStage<kernels::Lowest> {
    explicit constexpr erode_shaped(const StructuringElement& shape) : ShapedStage{shape} {}
};
/// With the reflected element, as dilate() takes it.
struct dilate_shaped : ShapedStage<kernels::Highest> {
    explicit constexpr dilate_shaped(const StructuringElement& shape) : ShapedStage{shape.reflected()} {}
};
struct opening_shaped {
    StructuringElement element;
    constexpr erode_shaped first() const { return erode_shaped(element); }
    constexpr dilate_shaped second() const { return dilate_shaped(element); }
};
struct closing_shaped {
    StructuringElement element;
    constexpr dilate_shaped first() const { return dilate_shaped(element); }
    constexpr erode_shaped second() const { return erode_shaped(element); }
};

}  // namespace stages
}  // namespace FOVEA_ISA
}  // namespace fovea
