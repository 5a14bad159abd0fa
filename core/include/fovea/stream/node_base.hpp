// SPDX-License-Identifier: MIT
//
// What the nodes of a stream share: room in scratch, the end of a stream, and what a stage and those behind
// it have in common.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

namespace detail {

/// Room in scratch begins where any pixel and a vector may lie.
inline constexpr int room_alignment = 64;
constexpr std::int64_t room(std::int64_t bytes) {
    return (bytes + room_alignment - 1) / room_alignment * room_alignment;
}

/// Rows that a stage must be given for output rows first to last.
struct RowRange {
    int first = 0;
    int last = -1;
};

template <class... Stages>
class Nodes;

/// The end of a stream: an accumulator.
template <class Accumulator>
class Nodes<Accumulator> {
public:
    using Input = typename Accumulator::Input;
    static_assert(is_accumulator_v<Accumulator>,
                  "the last stage of a stream must be an accumulator: into(image), "
                  "into(histogram), moments");

    Nodes() = default;
    explicit constexpr Nodes(const Accumulator& accumulator) : accumulator_(accumulator) {}

    constexpr std::int64_t scratch(int width) const {
        return has_place_v<Accumulator> ? 0 : room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    Status begin(Size size, Border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        if (const Status s = accumulator_.begin(size); s != Status::ok) return s;
        width_ = size.width;
        y_ = rows.first;
        row_ = reinterpret_cast<Input*>(bytes);
        wanted = rows;
        return Status::ok;
    }
    /// Where the next row is to be written.
    Input* slot() {
        if constexpr (has_place_v<Accumulator>)
            return accumulator_.place(y_);
        else
            return row_;
    }
    /// The row was written to slot().
    void pushed() {
        if constexpr (!has_place_v<Accumulator>) accumulator_.add_row(row_, width_, y_);
        ++y_;
    }
    /// The next row lies elsewhere.
    void take(const Input* row) {
        accumulator_.add_row(row, width_, y_);
        ++y_;
    }
    static constexpr bool valid() { return true; }
    Accumulator& accumulator() { return accumulator_; }
    const Accumulator& accumulator() const { return accumulator_; }

private:
    Accumulator accumulator_;
    int width_ = 0;
    int y_ = 0;
    Input* row_ = nullptr;
};

/// What the nodes of stages and taps are made of.
template <class Stage, class... Rest>
class NodeBase {
public:
    using Input = typename Stage::Input;
    using Next = Nodes<Rest...>;
    static_assert(std::is_same_v<typename Stage::Output, typename Next::Input>,
                  "a stage of the stream makes other pixels than the next one takes");

    NodeBase() = default;
    explicit constexpr NodeBase(const Stage& stage, const Rest&... rest) : stage_(stage), next_(rest...) {}

    /// False if a stage from here on has parameters that make no kernel: no memory is laid out then.
    constexpr bool valid() const {
        if constexpr (has_valid_v<Stage>)
            if (!stage_.valid()) return false;
        if constexpr (is_window_stage_v<Stage>)
            if (stage_.rows() < 1 || stage_.rows() > max_window_rows || stage_.rows() % 2 == 0) return false;
        return next_.valid();
    }
    auto& accumulator() { return next_.accumulator(); }
    const auto& accumulator() const { return next_.accumulator(); }

protected:
    Stage stage_;
    Next next_;
    int width_ = 0;
};

}  // namespace detail

}  // namespace fovea
