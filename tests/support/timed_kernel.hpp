// SPDX-License-Identifier: MIT
//
// TimedKernel: the real kernel with a time of its own, for tests of what waits.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>

#include <fovea/linux/kernel.hpp>

namespace fovea::test {

/// The time, and what is going to happen at moments to come while somebody waits.
struct TestTime {
    std::int64_t now_us = 1000000;
    std::multimap<std::int64_t, std::function<void()>> plan;
    int polls = 0;

    /// Lets time pass, and what is planned until then happen.
    void run_until(std::int64_t until_us) {
        while (!plan.empty() && plan.begin()->first <= until_us) {
            now_us = std::max(now_us, plan.begin()->first);
            const std::function<void()> event = plan.begin()->second;
            plan.erase(plan.begin());
            event();
        }
        now_us = std::max(now_us, until_us);
    }
};

/// Files are those of the machine; waiting for them takes no time but that of the test. Who waits for none
/// may wait for another thread, which is not of the test's time: up to a millisecond passes for it too.
class TimedKernel : public linux_port::Kernel {
public:
    explicit TimedKernel(TestTime& time) : time_(&time) {}

    int poll(Span<pollfd> files, std::int64_t patience_us) {
        ++time_->polls;
        if (files.empty()) static_cast<void>(Kernel::poll(files, std::min<std::int64_t>(patience_us, 1000)));
        const std::int64_t until_us = time_->now_us + patience_us;
        for (;;) {
            const int got = Kernel::poll(files, 0);
            if (got != 0 || time_->now_us >= until_us) return got;
            const bool planned = !time_->plan.empty() && time_->plan.begin()->first < until_us;
            time_->run_until(planned ? time_->plan.begin()->first : until_us);
        }
    }
    std::int64_t monotonic_us() { return time_->now_us; }

private:
    TestTime* time_;
};

}  // namespace fovea::test
