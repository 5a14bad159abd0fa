// SPDX-License-Identifier: MIT
//
// TestMachine: a machine with cameras, serial ports and GPIO chips, as Linux shows it in /sys, /dev and
// /proc; and the calls into it. Its folders are those of a test, its devices are simulated. Host tests only.
#pragma once

#include <linux/videodev2.h>

#include <cstring>
#include <deque>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fovea/linux/kernel.hpp>

#include <probe/machine.hpp>
#include <support/fake_gpio_chip.hpp>
#include <support/simulated_camera.hpp>
#include <support/temporary_folder.hpp>
#include <support/test_io.hpp>

namespace fovea::test {

struct TestMachine {
    struct Control {
        std::uint32_t id, type;
        const char* name;
        std::int64_t smallest, largest, step, otherwise, value;
        std::uint32_t flags = 0;
        bool kept = true;
    };

    TestMachine() {
        for (const char* part : {"sys/class", "dev", "proc/self", "etc/jobs"})
            std::filesystem::create_directories(folder.file(part));
        folder.write("etc/group", "root:x:0:\nvideo:x:44:pi\n");
        folder.write("proc/self/status",
                     "Name:\tfovea\nUid:\t1000\t1000\nGid:\t1000\t1000\nGroups:\t27 100 \n");
    }

    std::string path(const std::string& node) const { return folder.file("dev/" + node); }

    void usb(const std::string& place, const std::string& vendor, const std::string& product,
             const std::string& serial) {
        const std::string device = "sys/devices/soc/usb1/" + place;
        std::filesystem::create_directories(folder.file(device));
        folder.write(device + "/idVendor", vendor + "\n");
        folder.write(device + "/idProduct", product + "\n");
        if (!serial.empty()) folder.write(device + "/serial", serial + "\n");
    }
    /// A node of a class; without a device behind it where that is "".
    void node(const std::string& kind, const std::string& name, const std::string& device) {
        const std::string under = device.empty() ? "virtual" : device;
        const std::string place = "sys/devices/" + under + "/" + kind + "/" + name;
        std::filesystem::create_directories(folder.file(place));
        if (!device.empty())
            std::filesystem::create_directory_symlink("../..", folder.file(place + "/device"));
        std::filesystem::create_directories(folder.file("sys/class/" + kind));
        std::filesystem::create_directory_symlink("../../devices/" + under + "/" + kind + "/" + name,
                                                  folder.file("sys/class/" + kind + "/" + name));
        folder.write("dev/" + name, "");
    }
    SimulatedCamera& camera(const std::string& name, const std::string& device) {
        node("video4linux", name, device);
        cameras.emplace_back();
        cameras.back().path = path(name);
        return cameras.back();
    }
    FakeGpio::Chip& chip(const std::string& name, const std::string& label,
                         const std::vector<std::string>& lines) {
        folder.write("dev/" + name, "");
        gpio.chips.emplace_back();
        gpio.chips.back().name = name;
        gpio.chips.back().label = label;
        for (const std::string& line : lines) gpio.chips.back().lines.emplace_back().name = line;
        return gpio.chips.back();
    }
    /// A program that has a node open.
    void program(const std::string& id, const std::string& name, const std::string& node) {
        std::filesystem::create_directories(folder.file("proc/" + id + "/fd"));
        folder.write("proc/" + id + "/comm", name + "\n");
        std::filesystem::create_symlink(path(node), folder.file("proc/" + id + "/fd/7"));
    }

    TemporaryFolder folder;
    std::deque<SimulatedCamera> cameras;
    std::vector<Control> controls;                      ///< of every camera
    std::map<std::uint32_t, std::string> descriptions;  ///< of formats
    std::map<std::string, int> refused;                 ///< paths that cannot be opened, with the errno
    FakeGpio gpio;
};

/// Handles are those of the kernel, of a camera from 10000 on, and of a chip from 1000000 on.
class MachineSystem : public linux_port::Kernel {
public:
    explicit MachineSystem(TestMachine& machine) : machine_(&machine) {}

    int open(const char* path, int flags, unsigned mode = 0) {
        const auto refused = machine_->refused.find(path);
        if (refused != machine_->refused.end()) return -refused->second;
        for (std::size_t k = 0; k < machine_->cameras.size(); ++k)
            if (machine_->cameras[k].path == path) {
                const int got = video(k).open(path, flags);
                return got < 0 ? got : static_cast<int>(k + 1) * first_video + got;
            }
        const std::string chips = machine_->path("gpiochip");
        if (std::strncmp(path, chips.c_str(), chips.size()) != 0) return Kernel::open(path, flags, mode);
        const int got = chip().open(("/dev/gpiochip" + std::string(path + chips.size())).c_str(), flags);
        return got < 0 ? got : first_chip + got;
    }
    int close(int file) {
        if (file >= first_chip) return chip().close(file - first_chip);
        return file >= first_video ? video_of(file).close(0) : Kernel::close(file);
    }
    int ioctl(int file, unsigned long request, void* argument) {
        if (file >= first_chip) {
            const int got = chip().ioctl(file - first_chip, request, argument);
            if (request == GPIO_V2_GET_LINE_IOCTL && got >= 0)
                static_cast<gpio_v2_line_request*>(argument)->fd += first_chip;
            return got;
        }
        if (file < first_video) return Kernel::ioctl(file, request, argument);
        if (request == VIDIOC_QUERY_EXT_CTRL) return next(*static_cast<v4l2_query_ext_ctrl*>(argument));
        if (request == VIDIOC_G_EXT_CTRLS || request == VIDIOC_S_EXT_CTRLS)
            return exchange(request == VIDIOC_S_EXT_CTRLS,
                            *static_cast<v4l2_ext_controls*>(argument)->controls);
        if (request == VIDIOC_QUERYMENU) return choice(*static_cast<v4l2_querymenu*>(argument));
        const int got = video_of(file).ioctl(0, request, argument);
        if (request == VIDIOC_ENUM_FMT && got == 0) {
            auto& format = *static_cast<v4l2_fmtdesc*>(argument);
            std::strcpy(reinterpret_cast<char*>(format.description),
                        machine_->descriptions[format.pixelformat].c_str());
        }
        return got;
    }
    int poll(Span<pollfd> files, std::int64_t patience_us) {
        return files[0].fd >= first_video ? video_of(files[0].fd).poll(files, patience_us)
                                          : Kernel::poll(files, patience_us);
    }
    std::ptrdiff_t map(int file, std::int64_t offset, std::size_t length, std::uint8_t*& memory) {
        return video_of(file).map(0, offset, length, memory);
    }
    int unmap(std::uint8_t*, std::size_t) { return 0; }
    std::int64_t monotonic_us() { return machine_->cameras.empty() ? 0 : machine_->cameras[0].now_us; }

private:
    static constexpr int first_video = 10000;
    static constexpr int first_chip = 1000000;

    SimulatedVideo video(std::size_t k) { return SimulatedVideo(machine_->cameras[k]); }
    SimulatedVideo video_of(int file) { return video(static_cast<std::size_t>(file / first_video - 1)); }
    FakeGpioSystem chip() { return {&machine_->gpio}; }

    int next(v4l2_query_ext_ctrl& ask) {
        for (const TestMachine::Control& control : machine_->controls) {
            if (control.id <= (ask.id & ~V4L2_CTRL_FLAG_NEXT_CTRL)) continue;
            ask.id = control.id;
            ask.type = control.type;
            std::strcpy(ask.name, control.name);
            ask.minimum = control.smallest;
            ask.maximum = control.largest;
            ask.step = static_cast<std::uint64_t>(control.step);
            ask.default_value = control.otherwise;
            ask.flags = control.flags;
            return 0;
        }
        return -EINVAL;
    }
    int exchange(bool write, v4l2_ext_control& asked) {
        for (TestMachine::Control& control : machine_->controls) {
            if (control.id != asked.id) continue;
            if (write && control.kept) control.value = asked.value;
            if (!write) asked.value = static_cast<std::int32_t>(control.value);
            return 0;
        }
        return -EINVAL;
    }
    /// Every second choice is there.
    static int choice(v4l2_querymenu& asked) {
        if (asked.index % 2 == 0) return -EINVAL;
        std::strcpy(reinterpret_cast<char*>(asked.name),
                    asked.index == 1 ? "Manual Mode" : "Aperture Priority");
        return 0;
    }

    TestMachine* machine_;
};

/// What a command talks to on such a machine; System is MachineSystem, or one around it.
template <class AnySystem = MachineSystem>
class MachineIo : public TestIo {
public:
    MachineIo(TestMachine& machine, AnySystem system)
        : system_(system),
          sysfs_(machine.folder.file("sys")),
          nodes_(machine.folder.file("dev")),
          proc_(machine.folder.file("proc")),
          groups_(machine.folder.file("etc/group")) {}

    AnySystem system() { return system_; }
    apps::MachineFolders machine() const {
        return {sysfs_.c_str(), nodes_.c_str(), proc_.c_str(), groups_.c_str()};
    }
    bool says(const std::string& words) const { return out.find(words) != std::string::npos; }

private:
    AnySystem system_;
    std::string sysfs_, nodes_, proc_, groups_;
};

}  // namespace fovea::test
