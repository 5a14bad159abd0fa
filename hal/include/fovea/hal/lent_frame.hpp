// SPDX-License-Identifier: MIT
//
// LentFrame: a frame in the memory where its source keeps it.
#pragma once

#include <utility>

#include <fovea/base/assert.hpp>
#include <fovea/hal/frame_source.hpp>

namespace fovea::hal {

/// Gives itself back when it dies or is filled anew. Source is a friend, as this is of Source, and has
/// take_back(place).
template <class Source>
class LentFrame {
public:
    LentFrame() = default;
    LentFrame(LentFrame&& other) noexcept { *this = std::move(other); }
    LentFrame& operator=(LentFrame&& other) noexcept {
        if (this == &other) return *this;
        give_back();
        source_ = std::exchange(other.source_, nullptr);
        place_ = other.place_;
        info_ = std::exchange(other.info_, {});
        return *this;
    }
    ~LentFrame() { give_back(); }

    const FrameInfo& info() const { return info_; }
    bool empty() const { return source_ == nullptr; }
    void give_back() {
        if (source_ != nullptr) source_->take_back(place_);
        source_ = nullptr;
        info_ = {};
    }

private:
    friend Source;
    void lend(Source& source, int place, const FrameInfo& info) {
        FOVEA_ASSERT(empty());
        source_ = &source;
        place_ = place;
        info_ = info;
    }

    Source* source_ = nullptr;
    int place_ = 0;
    FrameInfo info_;
};

}  // namespace fovea::hal
