// SPDX-License-Identifier: MIT
//
// Nodes: the moving parts that stream() makes of stages. A node gives the one before it a slot for the next
// row, and passes on what it makes of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
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

/// What the nodes of a window stage, a point stage and a tap are made of.
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

/// A window stage: the rows of its window in a ring.
template <class Stage, class... Rest>
class WindowNode : public NodeBase<Stage, Rest...> {
    using Base = NodeBase<Stage, Rest...>;
    using Base::next_;
    using Base::stage_;
    using Base::width_;

public:
    using Base::Base;
    using typename Base::Input;

    /// The kernel's, the ring, and a row of zeros.
    constexpr std::int64_t scratch(int width) const {
        return room(stage_.scratch(width)) + (stage_.rows() + 1) * row_room(width) + next_.scratch(width);
    }
    Status begin(Size size, Border border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        RowRange out;
        const std::int64_t own = room(stage_.scratch(size.width));
        std::uint8_t* ring = bytes + own;
        zeros_ = reinterpret_cast<Input*>(ring + stage_.rows() * row_room(size.width));
        if (const Status s =
                next_.begin(size, border, ring + (stage_.rows() + 1) * row_room(size.width), rows, out);
            s != Status::ok)
            return s;
        width_ = size.width;
        height_ = size.height;
        border_ = border;
        if constexpr (has_border_v<Stage>) border_ = stage_.border(border);
        memory_ = ring;
        std::memset(reinterpret_cast<std::uint8_t*>(zeros_), 0,
                    sizeof(Input) * static_cast<std::size_t>(width_));
        kernel_ =
            stage_.kernel(border_, {bytes, static_cast<std::ptrdiff_t>(stage_.scratch(width_))}, width_);
        const int reach = stage_.rows() / 2;
        wanted = {maximum(0, out.first - reach), minimum(height_ - 1, out.last + reach)};
        next_in_ = wanted.first;
        next_out_ = out.first;
        last_out_ = out.last;
        return Status::ok;
    }
    Input* slot() { return own_row(next_in_); }
    void pushed() { arrived(own_row(next_in_)); }
    /// A row that stays where it is until the stream ends.
    void take(const Input* row) { arrived(row); }

private:
    static constexpr std::int64_t row_room(int width) {
        return room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    int place(int y) const { return y % stage_.rows(); }
    Input* own_row(int y) const { return reinterpret_cast<Input*>(memory_ + place(y) * row_room(width_)); }

    void arrived(const Input* row) {
        ring_[place(next_in_)] = row;
        ++next_in_;
        const int reach = stage_.rows() / 2;
        while (next_out_ <= last_out_ && (next_out_ + reach < next_in_ || next_in_ == height_)) {
            const Input* window[max_window_rows];
            for (int i = 0; i < stage_.rows(); ++i) {
                const int y = border_index(border_, next_out_ - reach + i, height_);
                window[i] = y == no_index ? zeros_ : ring_[place(y)];
            }
            kernel_(RowWindow<Input>(window, stage_.rows(), width_), next_.slot());
            ++next_out_;
            next_.pushed();
        }
    }

    typename Stage::Kernel kernel_{};
    const Input* ring_[max_window_rows] = {};
    Input* zeros_ = nullptr;
    std::uint8_t* memory_ = nullptr;
    Border border_ = Border::replicate;
    int height_ = 0;
    int next_in_ = 0;
    int next_out_ = 0;
    int last_out_ = -1;
};

/// A point stage: works in the row of the next stage where the pixel is the same.
template <class Stage, class... Rest>
class PointNode : public NodeBase<Stage, Rest...> {
    using Base = NodeBase<Stage, Rest...>;
    using Base::next_;
    using Base::stage_;
    using Base::width_;

public:
    using Base::Base;
    using typename Base::Input;

    constexpr std::int64_t scratch(int width) const { return own_room(width) + next_.scratch(width); }
    Status begin(Size size, Border border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        width_ = size.width;
        row_ = reinterpret_cast<Input*>(bytes);
        return next_.begin(size, border, bytes + own_room(size.width), rows, wanted);
    }
    Input* slot() {
        if constexpr (in_place)
            return next_.slot();
        else
            return row_;
    }
    void pushed() { take(slot()); }
    void take(const Input* row) {
        stage_.row(row, width_, next_.slot());
        next_.pushed();
    }

private:
    static constexpr bool in_place = std::is_same_v<typename Stage::Input, typename Stage::Output>;
    static constexpr std::int64_t own_room(int width) {
        return in_place ? 0 : room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    Input* row_ = nullptr;
};

/// A tap: looks at the row where it is.
template <class Stage, class... Rest>
class TapNode : public NodeBase<Stage, Rest...> {
    using Base = NodeBase<Stage, Rest...>;
    using Base::next_;
    using Base::stage_;
    using Base::width_;

public:
    using Base::Base;
    using typename Base::Input;

    constexpr std::int64_t scratch(int width) const { return next_.scratch(width); }
    Status begin(Size size, Border border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        if (const Status s = next_.begin(size, border, bytes, rows, wanted); s != Status::ok) return s;
        width_ = size.width;
        y_ = wanted.first;
        // What the stages behind want of a strip reaches into its neighbours, whose own strips show it.
        shown_ = rows;
        return stage_.accumulator.begin(size);
    }
    Input* slot() { return next_.slot(); }
    void pushed() {
        show(next_.slot());
        next_.pushed();
    }
    void take(const Input* row) {
        show(row);
        next_.take(row);
    }

private:
    void show(const Input* row) {
        if (y_ >= shown_.first && y_ <= shown_.last) stage_.accumulator.add_row(row, width_, y_);
        ++y_;
    }
    int y_ = 0;
    RowRange shown_;
};

template <class Stage, class... Rest>
using NodeOf = std::conditional_t<
    is_tap_v<Stage>, TapNode<Stage, Rest...>,
    std::conditional_t<is_window_stage_v<Stage>, WindowNode<Stage, Rest...>, PointNode<Stage, Rest...>>>;

template <class Stage, class Second, class... Rest>
class Nodes<Stage, Second, Rest...> : public NodeOf<Stage, Second, Rest...> {
public:
    using NodeOf<Stage, Second, Rest...>::NodeOf;
};

}  // namespace detail

}  // namespace fovea
