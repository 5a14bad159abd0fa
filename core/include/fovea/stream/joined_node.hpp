// SPDX-License-Identifier: MIT
//
// The node of a joined stage: its own stages inside, and the rows of the source until they are made.
#pragma once

#include <cstdint>
#include <utility>

#include <fovea/base/status.hpp>
#include <fovea/image/border.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/row_kernel.hpp>
#include <fovea/stream/node_base.hpp>
#include <fovea/stream/stage.hpp>

namespace fovea::detail {

template <class Stage, class... Rest>
class JoinedNode : public NodeBase<Stage, Rest...> {
    using Base = NodeBase<Stage, Rest...>;
    using Base::next_;
    using Base::stage_;
    using Base::width_;

public:
    using typename Base::Input;

    JoinedNode() = default;
    explicit constexpr JoinedNode(const Stage& stage, const Rest&... rest)
        : Base(stage, rest...), inside_(stage.inside(), Meeting()) {}

    constexpr bool valid() const {
        return Base::valid() && inside_.valid() && stage_.kept() >= 1 && stage_.kept() <= max_window_rows;
    }
    constexpr std::int64_t scratch(int width) const {
        return stage_.kept() * row_room(width) + inside_.scratch(width) + next_.scratch(width);
    }
    Status begin(Size size, Border border, std::uint8_t* bytes, RowRange rows, RowRange& wanted) {
        std::uint8_t* inside = bytes + stage_.kept() * row_room(size.width);
        RowRange out;
        if (const Status s = next_.begin(size, border, inside + inside_.scratch(size.width), rows, out);
            s != Status::ok)
            return s;
        if (const Status s = inside_.begin(size, border, inside, out, wanted); s != Status::ok) return s;
        width_ = size.width;
        memory_ = bytes;
        next_in_ = wanted.first;
        return Status::ok;
    }
    Input* slot() { return reinterpret_cast<Input*>(memory_ + place(next_in_) * row_room(width_)); }
    void pushed() { take(slot()); }
    void take(const Input* row) {
        kept_[place(next_in_)] = row;
        ++next_in_;
        // A stream may have been moved since the last row.
        inside_.accumulator().node = this;
        inside_.take(row);
    }

private:
    /// Where the stages inside end.
    struct Meeting {
        using Input = typename Stage::Made;
        JoinedNode* node = nullptr;

        static Status begin(Size) { return Status::ok; }
        void add_row(const Input* row, int width, int y) const {
            node->stage_.join(node->kept_[node->place(y)], row, width, node->next_.slot());
            node->next_.pushed();
        }
    };
    static constexpr std::int64_t row_room(int width) {
        return room(static_cast<std::int64_t>(sizeof(Input)) * width);
    }
    int place(int y) const { return y % stage_.kept(); }

    Nodes<decltype(std::declval<const Stage&>().inside()), Meeting> inside_;
    const Input* kept_[max_window_rows] = {};
    std::uint8_t* memory_ = nullptr;
    int next_in_ = 0;
};

}  // namespace fovea::detail
