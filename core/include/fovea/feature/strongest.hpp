// SPDX-License-Identifier: MIT
//
// What a bounded list keeps when more is found than it can hold.
#pragma once

#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/status.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Fills a list and keeps the strongest: where it is full, the entry that leaves_first() of all others goes.
/// leaves_first(a, b) is a strict order without equals. The full list is a heap with the weakest on top.
template <class T, class LeavesFirst>
class Strongest {
public:
    Strongest(ListView<T> list, LeavesFirst leaves_first) : list_(list), leaves_first_(leaves_first) {
        list_.clear();
    }

    void add(const T& entry) {
        if (list_.push(entry) == Status::ok) return;
        // Sorted, the weakest first, is a heap.
        if (!exceeded_) sort(list_.span(), leaves_first_);
        exceeded_ = true;
        if (list_.empty() || !leaves_first_(list_[0], entry)) return;
        int place = 0;
        for (int child = 1; child < list_.size(); child = 2 * place + 1) {
            if (child + 1 < list_.size() && leaves_first_(list_[child + 1], list_[child])) ++child;
            if (leaves_first_(entry, list_[child])) break;
            list_[place] = list_[child];
            place = child;
        }
        list_[place] = entry;
    }
    Status status() const { return exceeded_ ? Status::capacity_exceeded : Status::ok; }

private:
    ListView<T> list_;
    LeavesFirst leaves_first_;
    bool exceeded_ = false;
};

}  // namespace detail

}  // namespace fovea
