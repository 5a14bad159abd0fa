// SPDX-License-Identifier: MIT
//
// The camera port on the kernel's driver of USB cameras, which usb_camera.cpp is plugged into.
// usage: usb_camera_on_board USB_CAMERA modes|identity|controls|damaged|unplugging...
#include <linux/videodev2.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fovea/linux/device_identity.hpp>
#include <fovea/linux/v4l2_camera.hpp>
#include <fovea/linux/video_controls.hpp>

#include <board/test_frame.hpp>

#include "board/proof.hpp"

namespace fovea::board {
namespace {

using linux_port::CameraMode;
using linux_port::ControlSetting;
using linux_port::DeviceFinder;
using linux_port::DevicePath;
using linux_port::Kernel;
using Camera = linux_port::V4l2Camera<>;
using Nodes = List<DevicePath, 16>;

constexpr const char* any_camera = "usb:1209:0001";
constexpr std::int64_t second = 1000000;

const char* usb_camera = "";

std::string fault_of(const Camera& camera) {
    return std::string(camera.fault().call) + ": " + reason(camera.fault());
}

/// The camera in software, plugged in for as long as it lives. It holds no file of this program.
class PluggedIn {
public:
    explicit PluggedIn(std::vector<std::string> options, std::string told = "/dev/null")
        : told_(std::move(told)), options_(std::move(options)) {
        options_.insert(options_.begin(), usb_camera);
        std::vector<char*> words;
        for (std::string& option : options_) words.push_back(option.data());
        words.push_back(nullptr);
        std::fflush(stdout);
        process_ = ::fork();
        if (process_ != 0) return;
        const int file = ::open(told_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        ::dup2(file, 1);
        ::execv(usb_camera, words.data());
        ::_exit(127);
    }
    PluggedIn(const PluggedIn&) = delete;
    PluggedIn& operator=(const PluggedIn&) = delete;
    ~PluggedIn() { pull(); }

    void pull() {
        if (process_ <= 0) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
        process_ = 0;
    }
    /// What was set in it, as it prints that.
    std::vector<std::string> told() const {
        std::ifstream file(told_);
        std::vector<std::string> lines;
        for (std::string line; std::getline(file, line);)
            lines.push_back(line.substr(std::min(line.size(), std::strlen("usb camera: "))));
        return lines;
    }

    std::string last_told() const {
        const std::vector<std::string> lines = told();
        return "the camera said last: " + (lines.empty() ? "nothing" : lines.back());
    }

private:
    std::string told_;
    std::vector<std::string> options_;
    int process_ = 0;
};

void wait_us(std::int64_t time_us) {
    Kernel kernel;
    static_cast<void>(kernel.poll({nullptr, 0}, time_us));
}

Nodes nodes_of(const char* identity) {
    Nodes nodes;
    DeviceFinder<> finder;
    static_cast<void>(finder.find("video4linux", identity, nodes.view()));
    return nodes;
}

/// Waits until that many nodes are there.
Nodes await_nodes(const char* identity, int count) {
    Nodes nodes;
    for (int tries = 0; tries < 1000; ++tries) {
        nodes = nodes_of(identity);
        if (nodes.size() == count) break;
        wait_us(5000);
    }
    return nodes;
}

/// Opens the node that gives pictures, of all that an identity has, and starts it in a mode.
Status begin(Camera& camera, const char* identity, hal::PixelFormat format) {
    Status status = Status::not_found;
    for (const DevicePath& node : nodes_of(identity))
        if ((status = camera.open(node.c_str())) != Status::unsupported) break;
    if (status != Status::ok) return status;
    List<CameraMode, 256> modes;
    if (const Status s = camera.modes(modes.view()); s != Status::ok) return s;
    linux_port::CameraWish wish;
    wish.format = format;
    wish.interval_us = 33333;
    const linux_port::CameraChoice choice = choose_mode(modes.span(), wish);
    if (choice.index < 0) return Status::unsupported;
    if (const Status s = camera.configure(modes[choice.index].code, choice.size, wish.interval_us);
        s != Status::ok)
        return s;
    return camera.start();
}

/// Is a frame that of its number, byte by byte?
bool exact(const hal::FrameInfo& info, const test::CameraMode& mode) {
    const hal::Plane& plane = info.planes[0];
    if (plane.bytes.size() < 4 || info.size != Size{mode.width, mode.height}) return false;
    const test::Bytes wanted = test::test_frame(mode, test::test_frame_number(plane.bytes.data()));
    const bool rows = mode.bytes_per_pixel > 0;
    const std::size_t row =
        rows ? static_cast<std::size_t>(mode.width * mode.bytes_per_pixel) : wanted.size();
    const auto stride = static_cast<std::size_t>(plane.stride_bytes);
    if (!rows && static_cast<std::size_t>(plane.bytes.size()) != wanted.size()) return false;
    for (std::size_t y = 0; y < wanted.size() / row; ++y)
        if (std::memcmp(plane.bytes.data() + y * stride, wanted.data() + y * row, row) != 0) return false;
    return true;
}

void modes(Proof& proof) {
    // What was pulled a moment ago may still have its nodes.
    await_nodes(any_camera, 0);
    const PluggedIn plugged({}, "/tmp/modes");
    await_nodes(any_camera, 2);
    for (const auto& [format, name] :
         {std::pair{hal::PixelFormat::yuyv, "yuyv"}, std::pair{hal::PixelFormat::gray8, "grey"},
          std::pair{hal::PixelFormat::mjpeg, "mjpeg"}}) {
        Camera camera;
        const std::string what = std::string("USB, ") + describe(format);
        Status got = begin(camera, any_camera, format);
        if (!proof.check(got == Status::ok, what + ": start",
                         std::string(describe(got)) + ", " + fault_of(camera) + ", " + plugged.last_told()))
            continue;
        int right = 0;
        int rising = 0;
        std::uint32_t last = 0;
        Kernel kernel;
        for (int k = 0; k < 10; ++k) {
            Camera::Frame frame;
            if ((got = camera.next(5 * second, frame)) != Status::ok) break;
            if (exact(frame.info(), *test::camera_mode(name))) ++right;
            const std::uint32_t number = test::test_frame_number(frame.info().planes[0].bytes.data());
            if ((k == 0 || number > last) && frame.info().time_us <= kernel.monotonic_us()) ++rising;
            last = number;
        }
        proof.check(right == 10, what + ": 10 frames as they were sent, byte by byte",
                    std::to_string(right) + ", then " + describe(got) + ", " + fault_of(camera) + ", " +
                        plugged.last_told());
        proof.equal(rising, 10, what + ": in their order, none of the future");
        proof.equal(camera.counters().damaged, 0u, what + ": none is damaged");
        proof.equal(camera.interval_us(), 33333, what + ": the rate is what was asked for");
    }
}

/// Sets the gain of the camera at a node.
bool set_gain(const char* node, std::int64_t gain) {
    Camera camera;
    if (camera.open(node) != Status::ok) return false;
    Kernel kernel;
    ControlSetting setting;
    setting.name = "gain";
    setting.value = gain;
    linux_port::Fault fault;
    return set_controls(kernel, camera.file(), {&setting, 1}, fault) == Status::ok;
}

/// Two cameras that differ in their serial numbers alone, plugged in one after the other.
void identity(Proof& proof, const char* first, const char* other) {
    const PluggedIn one({"--serial", first}, "/tmp/one");
    await_nodes(any_camera, 2);
    const PluggedIn two({"--serial", other, "--port", "1"}, "/tmp/two");
    proof.equal(await_nodes(any_camera, 4).size(), 4, "two cameras with two nodes each");
    const std::string left = std::string(any_camera) + ":left";
    const Nodes nodes = nodes_of(left.c_str());
    const std::string order = std::string(first) + " first";
    if (!proof.equal(nodes.size(), 2, order + ": of one serial number there are two nodes")) return;
    proof.equal(std::string(nodes[0].c_str()),
                std::strcmp(first, "left") == 0 ? "/dev/video0" : "/dev/video2",
                order + ": the node of the camera");
    proof.check(set_gain(nodes[0].c_str(), 77), order + ": its gain is set");
    const bool at_first = std::strcmp(first, "left") == 0;
    const std::vector<std::string> set = (at_first ? one : two).told();
    proof.check(std::find(set.begin(), set.end(), "gain = 77") != set.end(), order + ": in that camera");
    proof.check((at_first ? two : one).told().empty(), order + ": and not in the other");

    Camera camera;
    proof.status(camera.open(nodes[1].c_str()), Status::unsupported, "a node of metadata is no camera");
    proof.check(std::strstr(reason(camera.fault()), "other node") != nullptr, "and says where the camera is",
                fault_of(camera));
    DeviceFinder<> finder;
    DevicePath path;
    proof.status(finder.resolve("video4linux", any_camera, path), Status::undecided,
                 "without its serial number a camera is undecided");
    proof.status(finder.resolve("video4linux", "usb:1209:0001:middle", path), Status::not_found,
                 "a serial number that is not there");

    // Its place: the last folders of its link in /sys.
    char target[512] = {};
    Kernel kernel;
    const std::string link = "/sys/class/video4linux/" + std::string(nodes[0].c_str()).substr(5);
    static_cast<void>(kernel.read_link(link.c_str(), Span<char>(target, sizeof target - 1)));
    const std::string place(target);
    const std::size_t end = place.find("/video4linux/");
    const std::size_t start = place.rfind('/', end - 1) + 1;
    const std::string by_place = "path:" + place.substr(start, end - start);
    const Nodes there = nodes_of(by_place.c_str());
    proof.check(there.size() == 2 && std::strcmp(there[0].c_str(), nodes[0].c_str()) == 0,
                order + ": its place has the same node", by_place);
}

void identities(Proof& proof) {
    identity(proof, "left", "right");
    proof.equal(await_nodes(any_camera, 0).size(), 0, "both are pulled");
    identity(proof, "right", "left");
}

void controls(Proof& proof) {
    await_nodes(any_camera, 0);
    const PluggedIn plugged({}, "/tmp/controls");
    await_nodes(any_camera, 2);
    Camera camera;
    proof.status(begin(camera, any_camera, hal::PixelFormat::gray8), Status::ok, "controls: start");
    Kernel kernel;
    linux_port::Fault fault;
    std::vector<ControlSetting> settings(4);
    const std::pair<const char*, std::int64_t> wanted[] = {
        {"exposure_time_absolute", 123}, {"gain", 99}, {"Auto Exposure", 1}, {"brightness", -5}};
    for (std::size_t k = 0; k < 4; ++k) {
        settings[k].name = wanted[k].first;
        settings[k].value = wanted[k].second;
    }
    proof.status(set_controls(kernel, camera.file(), {settings.data(), 4}, fault), Status::ok,
                 "controls by their names");
    std::vector<std::string> told;
    for (const std::string& line : plugged.told())
        if (line.find(" = ") != std::string::npos) told.push_back(line);
    const std::vector<std::string> order{"exposure_mode = 1", "exposure_100us = 123", "gain = 99",
                                         "brightness = -5"};
    std::string seen;
    for (const std::string& line : told) seen += line + "; ";
    proof.check(told == order, "arrive at the camera, the automatic mode first", seen);
    settings[1].value = 256;
    proof.status(set_controls(kernel, camera.file(), {&settings[1], 1}, fault), Status::out_of_range,
                 "a value out of range is refused");
    settings[1].name = "focus";
    proof.status(set_controls(kernel, camera.file(), {&settings[1], 1}, fault), Status::not_found,
                 "and a control that it does not have");
}

void set_nodrop(int value) { std::ofstream("/sys/module/uvcvideo/parameters/nodrop") << value; }

/// Frames 3 and 8 are marked as damaged, 6 and 11 end after their first half.
void damaged(Proof& proof, bool nodrop) {
    await_nodes(any_camera, 0);
    set_nodrop(nodrop ? 1 : 0);
    const PluggedIn plugged({"--damage", "3", "--cut", "6", "--damage", "8", "--cut", "11"});
    await_nodes(any_camera, 2);
    const std::string how = nodrop ? "damaged frames flagged" : "damaged frames kept by the driver";
    Camera camera;
    if (!proof.status(begin(camera, any_camera, hal::PixelFormat::gray8), Status::ok, how + ": start"))
        return;
    int right = 0;
    int lent = 0;
    bool wrong = false;
    for (std::uint32_t number = 0; number < 20;) {
        Camera::Frame frame;
        if (camera.next(2 * second, frame) != Status::ok) break;
        number = test::test_frame_number(frame.info().planes[0].bytes.data());
        wrong = wrong || number == 3 || number == 6 || number == 8 || number == 11;
        ++lent;
        if (exact(frame.info(), *test::camera_mode("grey"))) ++right;
    }
    proof.check(lent > 10 && right == lent && !wrong, how + ": none is lent, the others as they were sent",
                std::to_string(lent) + " lent, " + std::to_string(right) + " right");
    // The driver tells nothing of those that it keeps, but in the numbers of the others.
    const std::uint64_t counted = nodrop ? camera.counters().damaged : camera.counters().missed;
    proof.figure("USB, " + how + ": counted of 4", static_cast<std::int64_t>(counted), "");
    if (nodrop) proof.equal(counted, 4u, how + ": all 4 are counted");
    set_nodrop(0);
}

void unplugging(Proof& proof) {
    constexpr int cycles = 20;
    // Four frames may have arrived whole before, one in each buffer; the read behind them tells the loss.
    constexpr int most_reads = 5;
    std::string odd;
    await_nodes(any_camera, 0);
    const Holdings before = holdings();
    std::vector<std::int64_t> losses;
    std::vector<std::int64_t> from_plug;
    std::vector<std::int64_t> from_node;
    int lost = 0;
    int renumbered = 0;
    int right = 0;
    Kernel kernel;
    Camera camera;
    std::string node;
    for (int k = 0; k < cycles; ++k) {
        PluggedIn plugged({"--serial", "it"});
        const std::int64_t plugged_us = kernel.monotonic_us();
        Nodes nodes;
        Camera::Frame frame;
        std::int64_t found_us = plugged_us;
        Status got = Status::not_found;
        // The node of the camera that was pulled may still be there, and is lost when it is opened.
        while (got != Status::ok && kernel.monotonic_us() < plugged_us + 5 * second) {
            if (got == Status::device_lost || nodes.empty()) wait_us(2000);
            nodes = nodes_of("usb:1209:0001:it");
            if (nodes.empty()) continue;
            found_us = kernel.monotonic_us();
            got = begin(camera, "usb:1209:0001:it", hal::PixelFormat::gray8);
            if (got == Status::ok) got = camera.next(2 * second, frame);
        }
        // Every other time the camera that was lost is still held, as by a program that is slow to notice.
        if (!nodes.empty() && nodes[0].c_str() != node) ++renumbered;
        if (!nodes.empty()) node = nodes[0].c_str();
        if (!proof.check(got == Status::ok, "USB: found again and streaming", fault_of(camera))) return;
        from_plug.push_back(kernel.monotonic_us() - plugged_us);
        from_node.push_back(kernel.monotonic_us() - found_us);
        if (exact(frame.info(), *test::camera_mode("grey"))) ++right;
        frame.give_back();
        while (camera.next(0, frame) == Status::ok) frame.give_back();
        const std::int64_t pulled_us = kernel.monotonic_us();
        plugged.pull();
        int reads = 0;
        for (got = Status::ok; got == Status::ok; ++reads) got = camera.next(second, frame);
        losses.push_back(kernel.monotonic_us() - pulled_us);
        const bool told = got == Status::device_lost && frame.empty() && reads <= most_reads;
        if (told)
            ++lost;
        else
            odd += std::string(describe(got)) + " by read " + std::to_string(reads) + " (" +
                   fault_of(camera) + "); ";
        if (k % 2 == 0) camera.close();
        if (k % 2 == 0) await_nodes(any_camera, 0);
    }
    camera.close();
    await_nodes(any_camera, 0);
    const Holdings after = holdings();
    proof.check(lost == cycles, "USB: each time the loss is told by the read that finds no more frames", odd);
    proof.equal(right, cycles, "USB: each time the first frame is as it was sent");
    proof.figure("USB: times of 20 that the camera came back under another number", renumbered - 1, "");
    proof.check(renumbered > 5, "USB: it was found under another number too");
    proof.spread("USB: from the plug pulled in a stream to the loss", losses);
    proof.spread("USB: from the plug to the next frame, with the kernel's own time", from_plug);
    proof.spread("USB: from the node to the next frame", from_node);
    // The camera itself is a program on this board, and its frames take most of this time.
    proof.at_most(median(from_node), second, "USB: back within a second");
    proof.equal(after.files, before.files, "USB: as many files are open as before");
    proof.equal(after.mappings, before.mappings, "USB: as much is mapped as before");
}

}  // namespace
}  // namespace fovea::board

int main(int count, char** words) {
    using namespace fovea::board;
    Proof proof;
    if (count > 1) usb_camera = words[1];
    for (int k = 2; k < count; ++k) {
        const std::string part = words[k];
        if (part == "modes")
            modes(proof);
        else if (part == "identity")
            identities(proof);
        else if (part == "controls")
            controls(proof);
        else if (part == "damaged")
            damaged(proof, true), damaged(proof, false);
        else if (part == "unplugging")
            unplugging(proof);
        else
            proof.check(false, "a part named " + part);
    }
    return proof.end();
}
