// SPDX-License-Identifier: MIT
//
// DaemonWorld: all that the daemon is connected to, in memory: a simulated camera that looks at discs, six
// wires, a serial line, and time that passes when a test says so.
#pragma once

#include <linux/videodev2.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/linux/fault.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/simulated/byte_pipe.hpp>
#include <fovea/simulated/memory_storage.hpp>

#include <daemon/daemon.hpp>
#include <daemon/serial_link.hpp>

#include "support/daemon_invariants.hpp"
#include "support/simulated_camera.hpp"

namespace fovea::test {

/// A picture of a dark disc on bright ground, with a hole or without.
inline std::vector<std::uint8_t> disc_scene(int width, int height, int radius, bool hole) {
    std::vector<std::uint8_t> scene(static_cast<std::size_t>(width * height), std::uint8_t{220});
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const int dx = x - width / 2;
            const int dy = y - height / 2;
            const int square = dx * dx + dy * dy;
            if (square <= radius * radius && !(hole && square <= 16))
                scene[static_cast<std::size_t>(y * width + x)] = 30;
        }
    return scene;
}

/// A recipe of such a disc, with a hole, of a radius of 20 pixels.
inline std::string disc_recipe(const std::string& name = "disc") {
    return "format = 1\nname = \"" + name +
           "\"\n[locate]\npart = \"dark\"\nthreshold = \"fixed\"\nlevel = 128\norientation = "
           "\"none\"\narea_min = 100\n"
           "hole_area_min = 10\n[[feature]]\nname = \"holes\"\nkind = \"hole_count\"\nnominal = 1\nminus = "
           "0\nplus = 0\n"
           "[[feature]]\nname = \"d1\"\nkind = \"diameter\"\ncentre = [0, 0]\nradius = 20\nsearch = "
           "8\nnominal = 40\n"
           "minus = 1.5\nplus = 1.5\n";
}

class DaemonWorld {
public:
    struct Wire {
        Status set(bool active) {
            world->device.enter_call();
            if (broken) return Status::io_error;
            level = active;
            ++changes;
            world->invariants.take_level(line, active);
            return Status::ok;
        }
        DaemonWorld* world = nullptr;
        DaemonInvariants::Line line = DaemonInvariants::ready;
        bool level = false;
        bool broken = false;
        int changes = 0;
    };
    struct WorldClock {
        SimulatedCamera* device;
        std::int64_t microseconds() { return device->now_us; }
    };
    using Camera = linux_port::V4l2Camera<SimulatedVideo>;
    struct CameraOpening {
        Status operator()(Camera& camera) const {
            if (const Status s = camera.open("/dev/video0"); s != Status::ok) return s;
            if (const Status s = camera.configure(V4L2_PIX_FMT_GREY, {160, 120}, 40000); s != Status::ok)
                return s;
            return camera.start();
        }
    };
    /// A serial port of memory, which may be pulled.
    struct Port : simulated::BytePipe {
        Result<int> read(Span<std::uint8_t> into) {
            device->enter_call();
            if (pulled) return Status::device_lost;
            return BytePipe::read(into);
        }
        Result<int> write(Span<const std::uint8_t> bytes) {
            device->enter_call();
            if (pulled) return Status::device_lost;
            return BytePipe::write(bytes);
        }
        void close() { device->enter_call(); }
        SimulatedCamera* device = nullptr;
        bool pulled = false;
    };
    struct PortOpening {
        Status operator()(Port& opened) const {
            // By its identity: a folder is looked through.
            for (int k = 0; k < 10; ++k) opened.device->enter_call();
            return opened.pulled ? Status::not_found : Status::ok;
        }
    };
    using Keeper = apps::CameraKeeper<Camera, WorldClock, CameraOpening>;
    using Link = apps::SerialLink<Port, PortOpening>;
    using Lines = apps::VerdictLines<Wire>;

    explicit DaemonWorld(const apps::LineTiming& timing = {})
        : lines_({&wires[0], &wires[1], &wires[2], &wires[3], &wires[4], &wires[5]}, timing) {
        device.offered = {{V4L2_PIX_FMT_GREY, 160, 120, 40000}};
        good = disc_scene(160, 120, 20, true);
        bad = disc_scene(160, 120, 20, false);
        device.scene = &good;
        port.device = &device;
        storage.files["jobs/disc.toml"] = bytes(disc_recipe());
        storage.files["jobs/other.toml"] = bytes(disc_recipe("other"));
        problem = job_list.read(storage, "jobs", {"other", "disc"});
        scratch_room.resize(static_cast<std::size_t>(apps::judge_scratch({160, 120}, job_list[1])));
    }

    // ---- What the daemon sees ----

    std::int64_t now_us() { return device.now_us; }
    Keeper& camera() { return keeper_; }
    const char* camera_fault() { return linux_port::reason(camera_.fault()); }
    const char* camera_advice() { return linux_port::advice(camera_.fault()); }
    const char* link_fault() { return describe(link_.trouble()); }
    std::int64_t frame_interval_us() { return camera_.interval_us(); }
    std::uint64_t missed_frames() { return camera_.counters().missed; }
    Status gray(const hal::FrameInfo& info, ImageView<const Gray8>& picture) {
        invariants.take_frame(info.sequence, info.time_us, camera_.interval_us(),
                              undecodable == 0 && device.flagged.count(info.sequence) == 0);
        if (undecodable > 0) {
            --undecodable;
            return Status::malformed;
        }
        picture = {info.planes[0].bytes.data(), info.size, info.planes[0].stride_bytes};
        device.now_us += judging_us;
        return Status::ok;
    }
    apps::ImageVerdict quality(ImageView<const Gray8>) { return quality_verdict; }
    Link& link() { return link_; }
    Lines& lines() { return lines_; }
    bool next_edge(apps::TriggerEdge& edge) {
        if (edges.empty()) return false;
        edge = edges.front();
        edges.pop_front();
        invariants.take_edges(1 + std::uint64_t{edge.lost});
        return true;
    }
    Status trigger_status() const { return trigger; }
    void print(Span<const char> line) {
        device.enter_call();
        printed.emplace_back(line.begin(), line.end());
        invariants.take_said(printed.back());
    }
    void keep_failure(ImageView<const Gray8> picture, const apps::Inspection& inspection) {
        failures.push_back(inspection.number);
        if (on_failure) on_failure(picture);
    }
    bool take_failure_event(apps::FailureRingEvent& event) {
        if (failure_events.empty()) return false;
        event = failure_events.front();
        failure_events.pop_front();
        return true;
    }
    Status keep_sample(Span<const char> name, ImageView<const Gray8>, linux_port::Fault& fault) {
        fault = sample_fault;
        if (fault.status == Status::ok) samples.emplace_back(name.begin(), name.end());
        return fault.status;
    }
    OneWorker workers() { return {}; }
    Span<std::uint8_t> scratch() {
        return {scratch_room.data(), static_cast<std::ptrdiff_t>(scratch_room.size())};
    }
    const apps::JobList& jobs() { return job_list; }

    // ---- What a test does ----

    static std::vector<std::uint8_t> bytes(const std::string& text) { return {text.begin(), text.end()}; }
    void say(const std::string& text) { port.arriving.insert(port.arriving.end(), text.begin(), text.end()); }
    /// What was sent on the serial line since the last call.
    std::string heard() {
        const std::string text(port.sent.begin(), port.sent.end());
        port.sent.clear();
        return text;
    }
    /// The words of the events and verdicts printed since the last call.
    std::vector<std::string> events() {
        std::vector<std::string> words;
        for (const std::string& line : std::exchange(printed, {})) {
            const char* const key =
                line.find("\"ev\":\"result\"") != std::string::npos ? "\"verdict\":\"" : "\"ev\":\"";
            const std::size_t at = line.find(key) + std::string(key).size();
            words.push_back(line.substr(at, line.find('"', at) - at));
        }
        return words;
    }
    /// Lets time pass as poll() does: until something comes, or that moment. False: nothing came but the
    /// time.
    bool wait(std::int64_t until_us) {
        device.enter_call();
        const bool reads = link_.open() && (port.pulled || !port.arriving.empty());
        if (reads || !edges.empty() || device.would_wake()) return true;
        until_us = std::min(until_us, device.now_us + 1000000);
        const bool frame = device.wakes_at_us() <= until_us;
        device.run_until(frame ? device.wakes_at_us() : until_us);
        return frame;
    }
    /// How many things are wrong that it waits for the end of.
    int troubles() const {
        return (keeper_.trouble() != apps::CameraTrouble::none ? 1 : 0) + (link_.open() ? 0 : 1) +
               (link_.waiting() ? 1 : 0) + (lines_.lost() ? 1 : 0);
    }

    bool ready() const { return wires[0].level; }
    bool busy() const { return wires[1].level; }
    bool valid() const { return wires[2].level; }
    bool ok() const { return wires[3].level; }
    bool not_ok() const { return wires[4].level; }
    bool alarm() const { return wires[5].level; }

    SimulatedCamera device;
    std::vector<std::uint8_t> good;
    std::vector<std::uint8_t> bad;
    DaemonInvariants invariants;
    Wire wires[6] = {{this, DaemonInvariants::ready},  {this, DaemonInvariants::busy},
                     {this, DaemonInvariants::valid},  {this, DaemonInvariants::ok},
                     {this, DaemonInvariants::not_ok}, {this, DaemonInvariants::alarm}};
    Port port;
    std::deque<apps::TriggerEdge> edges;
    Status trigger = Status::ok;
    std::vector<std::string> printed;
    std::vector<std::uint64_t> failures;
    std::function<void(ImageView<const Gray8>)> on_failure;
    std::vector<std::string> samples;
    linux_port::Fault sample_fault;
    simulated::MemoryStorage storage;
    apps::JobList job_list;
    std::string problem;
    int undecodable = 0;
    std::int64_t judging_us = 0;
    apps::ImageVerdict quality_verdict = apps::ImageVerdict::fine;
    std::deque<apps::FailureRingEvent> failure_events;
    std::vector<std::uint8_t> scratch_room;

private:
    WorldClock clock_{&device};
    Camera camera_{SimulatedVideo(device)};
    Keeper keeper_{camera_, clock_, CameraOpening{}};
    std::vector<std::uint8_t> queue_room_ = std::vector<std::uint8_t>(4096);
    Link link_{port, PortOpening{}, {queue_room_.data(), 4096}};
    Lines lines_;
};

/// Lets the daemon run for that time: a turn when something comes, and when it wants one.
inline void run(DaemonWorld& world, apps::Daemon<DaemonWorld>& daemon, std::int64_t duration_us) {
    const std::int64_t until_us = world.device.now_us + duration_us;
    bool brought = true;
    int turns_at_once = 0;
    while (world.device.now_us < until_us) {
        const std::int64_t begin_us = world.device.now_us;
        const int before = world.device.calls;
        const std::int64_t next_us = daemon.turn();
        const bool came = world.wait(std::min(next_us, until_us));
        if (!brought)
            world.invariants.take_idle_turn(begin_us, world.device.calls - before, world.troubles());
        brought = came;
        turns_at_once = world.device.now_us > begin_us ? 0 : turns_at_once + 1;
        if (turns_at_once < 1000) continue;
        world.invariants.complaints.push_back("I5: 1000 turns without time between them");
        return;
    }
}

}  // namespace fovea::test
