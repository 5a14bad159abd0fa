// SPDX-License-Identifier: MIT
//
// LinuxWorld: the daemon's camera, serial port, lines and memory on a Linux system, as its settings name
// them.
#pragma once

#include <poll.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/codec/pnm.hpp>
#include <fovea/hal/frame_source.hpp>
#include <fovea/hal/record_queue.hpp>
#include <fovea/image/image_view.hpp>
#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/device_watch.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/file_stream.hpp>
#include <fovea/linux/gpio.hpp>
#include <fovea/linux/gpio_chip.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/monotonic_clock.hpp>
#include <fovea/linux/replace_file.hpp>
#include <fovea/linux/serial_port.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/worker_pool.hpp>

#include <daemon/camera_keeper.hpp>
#include <daemon/camera_opening.hpp>
#include <daemon/daemon.hpp>
#include <daemon/failure_ring.hpp>
#include <daemon/gray_frame.hpp>
#include <daemon/image_quality.hpp>
#include <daemon/inspection.hpp>
#include <daemon/jobs.hpp>
#include <daemon/judge.hpp>
#include <daemon/serial_link.hpp>
#include <daemon/serial_opening.hpp>
#include <daemon/settings.hpp>
#include <daemon/spare_files.hpp>
#include <daemon/verdict_lines.hpp>

namespace fovea::apps {

/// TheOpening is CameraOpening or ReplayOpening.
template <class TheOpening = CameraOpening<>>
class LinuxWorld {
public:
    using System = typename TheOpening::Calls;
    using Camera = typename TheOpening::Camera;
    using Clock = linux_port::MonotonicClock<System>;
    using Port = linux_port::SerialPort<System>;
    using Pin = linux_port::OutputLine<System>;
    /// The opening stays with the world: who looks for a reason finds it there.
    template <class Opening>
    struct OpenBy {
        Opening* opening;
        template <class Device>
        Status operator()(Device& device) const {
            return (*opening)(device);
        }
    };
    using Keeper = CameraKeeper<Camera, Clock, OpenBy<TheOpening>>;
    using Link = SerialLink<Port, OpenBy<SerialOpening<System>>>;
    using Lines = VerdictLines<Pin>;

    /// The jobs stay where they are, and may be others after take_settings().
    LinuxWorld(const Settings& settings, const JobList& jobs, System system)
        : settings_(settings), jobs_(jobs), system_(system) {}
    LinuxWorld(const LinuxWorld&) = delete;
    LinuxWorld& operator=(const LinuxWorld&) = delete;
    ~LinuxWorld() { static_cast<void>(finish()); }

    /// Ends all with the lines inactive. False where a disk hangs that pictures are written to: its thread is
    /// in the hands of the kernel, and only _exit() does not wait for it.
    bool finish() {
        lines_.make_safe();
        camera_.close();
        // Here and not at the end of the process, where the kernel would wait for a reader.
        port_.close();
        return failures_.stop(500000) != Status::timeout;
    }

    /// Opens what the settings name and lays out all memory. Empty if all is well, or what is not and what to
    /// try. A serial port that is not there may come later; a camera only if its size is set.
    std::string open();
    /// Takes the lines alone, all inactive: for a daemon that was killed and could not do it. Empty, or what
    /// is wrong.
    std::string make_safe() { return open_lines(); }

    // ---- What the daemon sees ----

    std::int64_t now_us() { return system_.monotonic_us(); }
    Keeper& camera() { return keeper_; }
    const char* camera_fault() {
        if (opening_.problem()[0] != '\0') return opening_.problem();
        // Silence is no answer of the kernel.
        return camera_.fault().status == Status::ok ? describe(keeper_.trouble_status())
                                                    : linux_port::reason(camera_.fault());
    }
    const char* camera_advice() {
        return opening_.problem()[0] != '\0' ? opening_.advice() : linux_port::advice(camera_.fault());
    }
    /// Of the opening, if that was refused; otherwise the port was open, and what ended it has its reason.
    const char* link_fault() {
        const linux_port::Fault& opening = port_opening_.fault();
        return linux_port::reason(opening.status != Status::ok ? opening : port_.fault());
    }
    std::int64_t frame_interval_us() const {
        return camera_.interval_us() > 0 ? camera_.interval_us() : 1000000 / settings_.camera.rate_per_s;
    }
    std::uint64_t missed_frames() const { return camera_.counters().missed; }
    Status gray(const hal::FrameInfo& info, ImageView<const Gray8>& picture) {
        const Result<ImageView<const Gray8>> got = gray_frame(info, span(gray_memory_), workers());
        if (got) picture = *got;
        return got.status();
    }
    ImageVerdict quality(ImageView<const Gray8> picture) {
        const Result<ImageQuality> measured = image_quality(picture, limits_, scratch(), workers());
        return measured ? judge(*measured, limits_) : ImageVerdict::fine;
    }
    Link& link() { return link_; }
    Lines& lines() { return lines_; }
    bool next_edge(TriggerEdge& edge) {
        if (!trigger_.is_open()) return false;
        linux_port::LineEdge got;
        const Status status = trigger_.next_edge(got);
        if (status != Status::ok) {
            if (status != Status::not_found) trigger_status_ = status;
            return false;
        }
        edge = {got.time_us, got.lost};
        return true;
    }
    /// ok as long as edges of the trigger's line are heard.
    Status trigger_status() const { return trigger_status_; }
    void print(Span<const char> line) {
        if (output_gone_) return;
        const std::ptrdiff_t size = line.size();
        if (size + 1 > static_cast<std::ptrdiff_t>(print_line_.size())) return;
        for (std::ptrdiff_t k = 0; k < size; ++k)
            print_line_[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(line[k]);
        print_line_[static_cast<std::size_t>(size)] = '\n';
        static_cast<void>(printed_.send({print_line_.data(), size + 1}));
        pump_output();
    }
    void keep_failure(ImageView<const Gray8> picture, const Inspection& inspection) {
        if (settings_.failures.folder.empty()) return;
        TextBuffer text{Span<char>(failure_text_)};
        write_json(inspection, text);
        // One that finds no place is counted as dropped.
        if (!text.full()) static_cast<void>(failures_.offer(picture, text.letters()));
    }
    bool take_failure_event(FailureRingEvent& event) { return failures_.take_event(event); }
    Status keep_sample(Span<const char> name, ImageView<const Gray8> picture, linux_port::Fault& fault);
    Span<std::uint8_t> scratch() { return span(judge_memory_); }
    linux_port::WorkerPool::Workers workers() { return pool_.workers(); }
    const JobList& jobs() const { return jobs_; }

    // ---- What the program does ----

    /// Takes settings of the same devices, between two frames: lays out the memory for the jobs anew.
    void take_settings(const Settings& settings) {
        settings_ = settings;
        lines_.set_timing(line_timing(settings_.lines));
        lay_out();
    }

    /// Waits until something has come from the camera, the serial port, the trigger's line or the file given,
    /// or that moment is there.
    void wait(std::int64_t until_us, int signals);
    const TheOpening& opening() const { return opening_; }

private:
    static Span<std::uint8_t> span(std::vector<std::uint8_t>& memory) {
        return {memory.data(), static_cast<std::ptrdiff_t>(memory.size())};
    }
    /// Who reads the output may go. To a pipe without a reader a poll would come back at once, for ever.
    void pump_output() {
        if (!output_gone_) output_gone_ = printed_.pump(output_) != Status::ok;
    }
    std::string open_camera();
    std::string open_lines();
    std::string open_serial();
    std::string begin_workers();
    std::string begin_failures();
    void lay_out();
    Size frame_size() const {
        // Of a camera that was there once, even if it is gone now: it comes back in this size or not at all.
        if (!opening_.size().empty()) return opening_.size();
        return {static_cast<int>(settings_.camera.width), static_cast<int>(settings_.camera.height)};
    }

    Settings settings_;
    const JobList& jobs_;
    System system_;
    Clock clock_{system_};
    Camera camera_{system_};
    TheOpening opening_{settings_, system_};
    Keeper keeper_{camera_, clock_, {&opening_}};
    Port port_{system_};
    SerialOpening<System> port_opening_{settings_.serial, system_};
    std::vector<std::uint8_t> link_memory_ = std::vector<std::uint8_t>(65536);
    Link link_{port_, {&port_opening_}, span(link_memory_), !settings_.serial.device.empty()};
    Pin ready_{system_};
    Pin busy_{system_};
    Pin valid_{system_};
    Pin ok_{system_};
    Pin not_ok_{system_};
    Pin alarm_{system_};
    linux_port::InputLine<System> trigger_{system_};
    Status trigger_status_ = Status::ok;
    Lines lines_{{}, {}};
    linux_port::DeviceWatch<System> watch_{system_};
    linux_port::FileStream<System> output_{system_, 1};
    std::vector<std::uint8_t> print_memory_ = std::vector<std::uint8_t>(262144);
    std::vector<std::uint8_t> print_line_ = std::vector<std::uint8_t>(16384 + 1);
    hal::RecordQueue printed_{span(print_memory_)};
    bool output_gone_ = false;
    linux_port::WorkerPool pool_;
    std::vector<std::uint8_t> gray_memory_;
    std::vector<std::uint8_t> judge_memory_;
    std::vector<std::uint8_t> sample_memory_;
    std::vector<std::uint8_t> failure_memory_;
    char failure_text_[FailureRing<System>::most_text];
    FailureRing<System> failures_{system_};
    ImageQualityLimits limits_;
};

// ---- Implementation ---------------------------------------------------------------

template <class TheOpening>
std::string LinuxWorld<TheOpening>::open() {
    // Without it a device that comes is found a little later.
    static_cast<void>(watch_.open());
    std::string problem = open_lines();
    if (problem.empty()) problem = open_camera();
    if (problem.empty()) problem = open_serial();
    if (problem.empty()) problem = begin_workers();
    if (!problem.empty()) return problem;
    lay_out();
    if (problem = begin_failures(); !problem.empty()) return problem;
    linux_port::Fault fault;
    if (find_spare_files(system_, fault) == Status::ok) return "";
    return std::string(linux_port::reason(fault)) + "; " + linux_port::advice(fault);
}

template <class TheOpening>
std::string LinuxWorld<TheOpening>::open_camera() {
    if (keeper_.open()) return "";
    const Status fault = camera_.fault().status;
    const bool absent = keeper_.trouble() == CameraTrouble::lost;
    const bool sized = settings_.camera.width > 0 && settings_.camera.height > 0;
    if (absent && sized && fault != Status::io_error) return "";
    std::string problem = camera_fault();
    if (camera_advice()[0] != '\0') problem += std::string("; ") + camera_advice();
    if (absent && !sized) problem += "; with width and height in [camera] the daemon would wait for it";
    return problem;
}

template <class TheOpening>
std::string LinuxWorld<TheOpening>::open_lines() {
    const Settings::Lines& names = settings_.lines;
    const bool triggered = settings_.trigger.source == TriggerSource::line;
    if (names.chip.empty()) return "";
    linux_port::GpioChip<System> chip(system_);
    const auto complain = [&](const char* role, const char* line, const linux_port::Fault& fault) {
        const char* const advice = linux_port::advice(fault);
        return std::string(names.chip.c_str()) +
               (line[0] != '\0' ? std::string(" line ") + line + " (" + role + ")" : "") + ": " + fault.call +
               ": " + linux_port::reason(fault) +
               (fault.about[0] != '\0' && fault.error != 0 ? std::string(": ") + fault.about : "") +
               (advice[0] != '\0' ? std::string("; ") + advice : "");
    };
    if (chip.open(names.chip.c_str()) != Status::ok) return complain("", "", chip.fault());
    const linux_port::LineLevel active =
        names.active_low ? linux_port::LineLevel::low : linux_port::LineLevel::high;
    linux_port::OutputLineOptions output;
    output.active = active;
    const struct {
        const Text<63>& name;
        const char* role;
        Pin& pin;
    } outputs[] = {{names.ready, "ready", ready_}, {names.busy, "busy", busy_},
                   {names.valid, "valid", valid_}, {names.ok, "ok", ok_},
                   {names.not_ok, "ng", not_ok_},  {names.alarm, "alarm", alarm_}};
    for (const auto& each : outputs)
        if (!each.name.empty() && each.pin.open(chip, each.name.c_str(), each.role, output) != Status::ok)
            return complain(each.role, each.name.c_str(), each.pin.fault());
    if (triggered) {
        linux_port::InputLineOptions input;
        input.active = active;
        input.debounce_us = static_cast<std::uint32_t>(settings_.trigger.debounce_us);
        if (trigger_.open(chip, settings_.trigger.line.c_str(), "trigger", input) != Status::ok)
            return complain("trigger", settings_.trigger.line.c_str(), trigger_.fault());
    }
    const auto wired = [](Pin& pin) { return pin.is_open() ? &pin : nullptr; };
    lines_ = Lines({wired(ready_), wired(busy_), wired(valid_), wired(ok_), wired(not_ok_), wired(alarm_)},
                   line_timing(names));
    return "";
}

template <class TheOpening>
std::string LinuxWorld<TheOpening>::open_serial() {
    if (settings_.serial.device.empty()) return "";
    link_.turn(now_us());
    // One that is not there yet may be plugged in; one that another has will stay so.
    const linux_port::Fault& fault = port_opening_.fault();
    if (link_.open() || fault.error != EBUSY) return "";
    return std::string(settings_.serial.device.c_str()) + ": " + fault.call + ": " +
           linux_port::reason(fault) + "; " + linux_port::advice(fault);
}

template <class TheOpening>
std::string LinuxWorld<TheOpening>::begin_workers() {
    constexpr int most_by_default = 4;
    auto threads = static_cast<int>(settings_.processor.threads);
    // A kernel that does not tell has one.
    if (threads == 0) threads = std::clamp(system_.processors(), 1, most_by_default);
    linux_port::Fault fault;
    const Status started = pool_.start(threads, fault);
    if (started == Status::ok) return "";
    return std::string("[processor] threads: ") + fault.call + ": " + linux_port::reason(fault) +
           "; with threads = 1 none is begun";
}

template <class TheOpening>
void LinuxWorld<TheOpening>::lay_out() {
    const Size size = frame_size();
    const int count = workers().count();
    std::int64_t gray = 0;
    // A camera that is not there yet, or that another takes the place of, may send any format.
    for (int k = 1; k < hal::pixel_formats; ++k)
        gray = std::max(gray, gray_frame_scratch(static_cast<hal::PixelFormat>(k), size, count));
    std::int64_t judge = image_quality_scratch(count);
    for (int number = 1; number <= jobs_.size(); ++number)
        judge = std::max(judge, judge_scratch(size, jobs_[number], count));
    gray_memory_.resize(static_cast<std::size_t>(gray));
    judge_memory_.resize(static_cast<std::size_t>(judge));
    sample_memory_.resize(static_cast<std::size_t>(size.area() + 64));
    limits_ = quality_limits(settings_.quality);
}

template <class TheOpening>
std::string LinuxWorld<TheOpening>::begin_failures() {
    if (settings_.failures.folder.empty()) return "";
    constexpr int places = 4;
    const Size size = frame_size();
    failure_memory_.resize(static_cast<std::size_t>(FailureRing<System>::memory_bytes(places, size)));
    const linux_port::RingLimits ring{settings_.failures.megabytes * 1000000,
                                      static_cast<int>(settings_.failures.pictures)};
    const Status started =
        failures_.start(settings_.failures.folder.c_str(), ring, places, size, span(failure_memory_));
    if (started == Status::ok) return "";
    return std::string("[failures] ") + settings_.failures.folder.c_str() + ": " +
           (failures_.fault().error != 0 ? linux_port::reason(failures_.fault()) : describe(started));
}

template <class TheOpening>
Status LinuxWorld<TheOpening>::keep_sample(Span<const char> name, ImageView<const Gray8> picture,
                                           linux_port::Fault& fault) {
    if (settings_.teach.folder.empty()) return Status::unsupported;
    const Result<std::ptrdiff_t> bytes = encode_pnm(picture, span(sample_memory_));
    if (!bytes) return bytes.status();
    linux_port::Text<400> path(settings_.teach.folder.c_str());
    path.add("/").add(name).add("-");
    linux_port::Text<400> beside = path;
    path.add_number(static_cast<std::uint64_t>(now_us())).add(".pgm");
    beside.add("new");
    // One that is there, or cannot be made, shows when the file is written.
    static_cast<void>(system_.make_folder(settings_.teach.folder.c_str(), 0755));
    return linux_port::replace_file(system_, settings_.teach.folder.c_str(), beside.c_str(), path.c_str(), {},
                                    {sample_memory_.data(), *bytes}, fault);
}

template <class TheOpening>
void LinuxWorld<TheOpening>::wait(std::int64_t until_us, int signals) {
    const std::int64_t left_us = std::min(until_us - now_us(), TheOpening::look_us);
    if (left_us <= 0) return;
    pollfd files[6] = {{signals, POLLIN, 0},
                       {keeper_.streaming() ? TheOpening::file(camera_) : -1, POLLIN | POLLPRI, 0},
                       {port_.file(), static_cast<short>(POLLIN | (link_.waiting() ? POLLOUT : 0)), 0},
                       {trigger_.file(), POLLIN, 0},
                       {!output_gone_ && printed_.waiting() > 0 ? 1 : -1, POLLOUT, 0},
                       {watch_.file(), POLLIN, 0}};
    static_cast<void>(system_.poll(files, left_us));
    if (files[5].revents != 0 && watch_.take()) {
        keeper_.hurry();
        link_.hurry();
    }
    pump_output();
}

}  // namespace fovea::apps
