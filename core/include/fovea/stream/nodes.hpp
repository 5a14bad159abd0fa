// SPDX-License-Identifier: MIT
//
// Nodes: the moving parts that stream() makes of stages. A node gives the one before it a slot for the next
// row, and passes on what it makes of it.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/stream/joined_node.hpp>
#include <fovea/stream/node_base.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea {

namespace detail {

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

    /// The kernel's, the ring, and the row that stands outside a zero border.
    constexpr std::int64_t scratch(int width) const {
        return room(stage_.scratch(width)) + (stage_.rows() + 1) * row_room(width) + next_.scratch(width);
    }
    Status begin(Size size, Border border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        RowRange out;
        const std::int64_t own = room(stage_.scratch(size.width));
        std::uint8_t* ring = bytes + own;
        outside_ = reinterpret_cast<Input*>(ring + stage_.rows() * row_room(size.width));
        if (const Status s =
                next_.begin(size, border, ring + (stage_.rows() + 1) * row_room(size.width), rows, out);
            s != Status::ok)
            return s;
        width_ = size.width;
        height_ = size.height;
        border_ = border;
        if constexpr (has_border_v<Stage>) border_ = stage_.border(border);
        memory_ = ring;
        int level = 0;
        if constexpr (has_outside_v<Stage>) level = stage_.outside();
        std::memset(reinterpret_cast<std::uint8_t*>(outside_), level,
                    sizeof(Input) * static_cast<std::size_t>(width_));
        kernel_ =
            stage_.kernel(border_, {bytes, static_cast<std::ptrdiff_t>(stage_.scratch(width_))}, width_);
        const int reach = stage_.rows() / 2;
        wanted = {maximum(0, out.first - reach), minimum(height_ - 1, out.last + reach)};
        next_in_ = wanted.first;
        next_out_ = out.first;
        last_out_ = out.last;
        follows_ = false;
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
                window[i] = y == no_index ? outside_ : ring_[place(y)];
            }
            make_row(kernel_, RowWindow<Input>(window, stage_.rows(), width_), follows_, next_.slot());
            follows_ = true;
            ++next_out_;
            next_.pushed();
        }
    }

    typename Stage::Kernel kernel_{};
    const Input* ring_[max_window_rows] = {};
    Input* outside_ = nullptr;
    std::uint8_t* memory_ = nullptr;
    Border border_ = Border::replicate;
    int height_ = 0;
    int next_in_ = 0;
    int next_out_ = 0;
    int last_out_ = -1;
    bool follows_ = false;
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
        if constexpr (has_begin_v<Stage>)
            if (const Status s = stage_.begin(size); s != Status::ok) return s;
        if (const Status s = next_.begin(size, border, bytes + own_room(size.width), rows, wanted);
            s != Status::ok)
            return s;
        width_ = size.width;
        y_ = wanted.first;
        row_ = reinterpret_cast<Input*>(bytes);
        return Status::ok;
    }
    Input* slot() {
        if constexpr (in_place)
            return next_.slot();
        else
            return row_;
    }
    void pushed() { take(slot()); }
    void take(const Input* row) {
        if constexpr (has_row_number_v<Stage>)
            stage_.row(row, width_, y_, next_.slot());
        else
            stage_.row(row, width_, next_.slot());
        ++y_;
        next_.pushed();
    }

private:
    static constexpr bool in_place = std::is_same_v<typename Stage::Input, typename Stage::Output>;
    static constexpr std::int64_t own_room(int width) {
        return in_place ? 0 : room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    Input* row_ = nullptr;
    int y_ = 0;
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

/// A composite stage: the nodes of its two stages.
template <class Stage, class... Rest>
class CompositeNode : public Nodes<decltype(std::declval<const Stage&>().first()),
                                   decltype(std::declval<const Stage&>().second()), Rest...> {
    using Base = Nodes<decltype(std::declval<const Stage&>().first()),
                       decltype(std::declval<const Stage&>().second()), Rest...>;

public:
    CompositeNode() = default;
    explicit constexpr CompositeNode(const Stage& stage, const Rest&... rest)
        : Base(stage.first(), stage.second(), rest...) {}
};

template <class Stage, class... Rest>
constexpr auto node_of() {
    if constexpr (is_tap_v<Stage>)
        return static_cast<TapNode<Stage, Rest...>*>(nullptr);
    else if constexpr (is_composite_v<Stage>)
        return static_cast<CompositeNode<Stage, Rest...>*>(nullptr);
    else if constexpr (is_joined_v<Stage>)
        return static_cast<JoinedNode<Stage, Rest...>*>(nullptr);
    else if constexpr (is_window_stage_v<Stage>)
        return static_cast<WindowNode<Stage, Rest...>*>(nullptr);
    else
        return static_cast<PointNode<Stage, Rest...>*>(nullptr);
}
template <class Stage, class... Rest>
using NodeOf = std::remove_pointer_t<decltype(node_of<Stage, Rest...>())>;

template <class Stage, class Second, class... Rest>
class Nodes<Stage, Second, Rest...> : public NodeOf<Stage, Second, Rest...> {
public:
    using NodeOf<Stage, Second, Rest...>::NodeOf;
};

}  // namespace detail

}  // namespace fovea
