// SPDX-License-Identifier: MIT
//
// Teaching: what TEACH asked for, until a frame answers it or none does.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/linux/fault.hpp>

#include <daemon/command.hpp>
#include <daemon/daemon_events.hpp>
#include <daemon/jobs.hpp>
#include <daemon/judge.hpp>
#include <daemon/text_buffer.hpp>

namespace fovea::apps {

/// World as Daemon has it.
template <class World>
class Teaching {
public:
    explicit Teaching(World& world) : world_(world) {}

    bool pending() const { return !name_.empty(); }
    /// What is taught is what lies there when it is asked for: a frame that begins after this.
    std::int64_t since_us() const { return since_us_; }

    /// A sample is to be kept by that name, or the codes that are seen are those that the job allows.
    void begin(Span<const char> name, bool sample, bool codes) {
        name_ = Text<longest_job_name>().add(name);
        since_us_ = world_.now_us();
        sample_ = sample;
        codes_ = codes;
    }

    void take(ImageView<const Gray8> picture, const Job& job, Judge& judge, DaemonEvents<World>& events) {
        if (sample_) {
            linux_port::Fault fault;
            const Status kept = world_.keep_sample(name(), picture, fault);
            events.tell_sample(name(), kept, fault);
        }
        if (codes_) {
            const char* const reason = judge.teach(picture, job, world_.scratch());
            events.tell_taught(name(), judge.taught(), reason);
        }
        name_.clear();
    }

    /// No frame of it will come: told with a word why.
    void give_up(const char* reason, Status status, DaemonEvents<World>& events) {
        if (!pending()) return;
        if (sample_) events.tell_sample(name(), status, {});
        if (codes_) events.tell_taught(name(), {}, reason);
        name_.clear();
    }

private:
    Span<const char> name() const { return {name_.c_str(), name_.size()}; }

    World& world_;
    Text<longest_job_name> name_;
    std::int64_t since_us_ = 0;
    bool sample_ = false;
    bool codes_ = false;
};

}  // namespace fovea::apps
