// SPDX-License-Identifier: MIT
//
// BytePipe: a serial line in memory, for tests of the applications.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>

namespace fovea::simulated {

/// What is put into `arriving` is read, `room` bytes are taken until it is made larger; `broken` answers
/// io_error.
class BytePipe {
public:
    Result<int> read(Span<std::uint8_t> into) {
        if (broken) return Status::io_error;
        int count = 0;
        for (; count < into.size() && !arriving.empty(); arriving.pop_front())
            into[count++] = arriving.front();
        return count;
    }
    Result<int> write(Span<const std::uint8_t> bytes) {
        if (broken) return Status::io_error;
        const int count = static_cast<int>(std::min<std::ptrdiff_t>(bytes.size(), room));
        sent.insert(sent.end(), bytes.begin(), bytes.begin() + count);
        room -= count;
        return count;
    }

    std::deque<std::uint8_t> arriving;
    std::vector<std::uint8_t> sent;
    int room = 1 << 20;
    bool broken = false;
};

static_assert(hal::is_byte_stream_v<BytePipe>);

}  // namespace fovea::simulated
