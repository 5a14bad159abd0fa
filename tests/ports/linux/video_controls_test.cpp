// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <linux/videodev2.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/linux/video_controls.hpp>

#include "support/failing_system.hpp"

namespace fovea::linux_port {
namespace {

/// Controls as a driver keeps them. Exposure can be set while the automatic mode is off, as in many webcams.
struct Controls {
    struct Control {
        std::uint32_t id;
        const char* name;
        v4l2_ctrl_type type;
        std::int64_t smallest;
        std::int64_t largest;
        std::uint64_t step;
        std::uint32_t flags;
        std::int64_t value;
    };
    std::vector<Control> all = {
        {0x980900, "Brightness", V4L2_CTRL_TYPE_INTEGER, -64, 64, 1, 0, 0},
        {0x980913, "Gain", V4L2_CTRL_TYPE_INTEGER, 0, 250, 10, 0, 0},
        {0x98091d, "Chip Temperature", V4L2_CTRL_TYPE_INTEGER, 0, 100, 1, V4L2_CTRL_FLAG_READ_ONLY, 40},
        {0x9a0901, "Auto Exposure", V4L2_CTRL_TYPE_MENU, 0, 3, 1, 0, 3},
        {0x9a0902, "Exposure Time, Absolute", V4L2_CTRL_TYPE_INTEGER, 1, 5000, 1, 0, 100},
        {0x9a0910, "Pixel Clock", V4L2_CTRL_TYPE_INTEGER64, 0, std::int64_t{1} << 40, 1, 0, 0},
        {0x9a0911, "Serial Number", V4L2_CTRL_TYPE_STRING, 0, 10, 1, 0, 0},
    };
    std::vector<std::string> written;
    bool keeps_nothing = false;
};

class ControlSystem {
public:
    explicit ControlSystem(Controls& controls) : controls_(&controls) {}
    int ioctl(int, unsigned long request, void* argument) {
        if (request == VIDIOC_QUERY_EXT_CTRL) {
            auto& ask = *static_cast<v4l2_query_ext_ctrl*>(argument);
            const std::uint32_t after = ask.id & ~V4L2_CTRL_FLAG_NEXT_CTRL;
            for (const auto& control : controls_->all) {
                if (control.id <= after) continue;
                ask.id = control.id;
                ask.type = control.type;
                std::strcpy(ask.name, control.name);
                ask.minimum = control.smallest;
                ask.maximum = control.largest;
                ask.step = control.step;
                ask.flags = control.flags;
                if (control.id == 0x9a0902 && controls_->all[3].value != 1)
                    ask.flags |= V4L2_CTRL_FLAG_INACTIVE;
                return 0;
            }
            return -EINVAL;
        }
        v4l2_ext_control& asked = *static_cast<v4l2_ext_controls*>(argument)->controls;
        for (auto& control : controls_->all) {
            if (control.id != asked.id) continue;
            const bool wide = control.type == V4L2_CTRL_TYPE_INTEGER64;
            if (request == VIDIOC_S_EXT_CTRLS) {
                controls_->written.push_back(control.name);
                if (!controls_->keeps_nothing) control.value = wide ? asked.value64 : asked.value;
            } else if (wide) {
                asked.value64 = control.value;
            } else {
                asked.value = static_cast<std::int32_t>(control.value);
            }
            return 0;
        }
        return -EINVAL;
    }

private:
    Controls* controls_;
};

Status set(Controls& controls, std::vector<ControlSetting>& settings) {
    ControlSystem system(controls);
    Fault fault;
    return set_controls(system, 3, {settings.data(), static_cast<std::ptrdiff_t>(settings.size())}, fault);
}

ControlSetting setting(const char* name, std::int64_t value) {
    ControlSetting made;
    made.name = name;
    made.value = value;
    return made;
}

TEST(NamesControl, AgreesWithWhatDriversAndToolsWrite) {
    EXPECT_TRUE(names_control("exposure_time_absolute", "Exposure Time, Absolute"));
    EXPECT_TRUE(names_control("Exposure Time, Absolute", "Exposure Time, Absolute"));
    EXPECT_TRUE(names_control("gain", "Gain"));
    EXPECT_TRUE(names_control("white_balance_automatic", "White Balance, Automatic"));
    EXPECT_FALSE(names_control("exposure_time", "Exposure Time, Absolute"));
    EXPECT_FALSE(names_control("exposuretime_absolute", "Exposure Time, Absolute"));
    EXPECT_FALSE(names_control("gains", "Gain"));
    EXPECT_FALSE(names_control("", "Gain"));
    EXPECT_FALSE(names_control("gain", ""));
}

TEST(SetControls, SetsAutomaticModesFirst) {
    Controls controls;
    std::vector<ControlSetting> settings = {setting("exposure_time_absolute", 250), setting("gain", 20),
                                            setting("auto_exposure", 1),
                                            setting("pixel_clock", std::int64_t{1} << 39)};
    EXPECT_EQ(set(controls, settings), Status::ok);
    EXPECT_EQ(controls.written,
              (std::vector<std::string>{"Auto Exposure", "Exposure Time, Absolute", "Gain", "Pixel Clock"}));
    EXPECT_EQ(settings[0].now, 250);
    EXPECT_FALSE(settings[0].inactive);
    EXPECT_EQ(settings[3].now, std::int64_t{1} << 39);
}

TEST(SetControls, TellsWhatHasNoEffect) {
    Controls controls;
    std::vector<ControlSetting> settings = {setting("exposure_time_absolute", 250)};
    EXPECT_EQ(set(controls, settings), Status::ok);
    EXPECT_TRUE(settings[0].inactive);
}

TEST(SetControls, TellsEachFaultAndSetsTheRest) {
    Controls controls;
    std::vector<ControlSetting> settings = {
        setting("focus", 1),        setting("gain", 251),           setting("gain", 5),
        setting("brightness", -65), setting("chip_temperature", 1), setting("serial_number", 1),
        setting("brightness", -64)};
    EXPECT_EQ(set(controls, settings), Status::not_found);
    EXPECT_EQ(settings[1].status, Status::out_of_range);
    EXPECT_EQ(settings[1].largest, 250);
    EXPECT_EQ(settings[2].status, Status::out_of_range);
    EXPECT_EQ(settings[2].step, 10u);
    EXPECT_EQ(settings[3].status, Status::out_of_range);
    EXPECT_EQ(settings[4].status, Status::bad_argument);
    EXPECT_EQ(settings[5].status, Status::bad_argument);
    EXPECT_EQ(settings[6].status, Status::ok);
    EXPECT_EQ(controls.written, (std::vector<std::string>{"Brightness"}));
}

TEST(SetControls, ReadsBackWhatWasSet) {
    Controls controls;
    controls.keeps_nothing = true;
    std::vector<ControlSetting> settings = {setting("gain", 20)};
    EXPECT_EQ(set(controls, settings), Status::irregular);
    EXPECT_EQ(settings[0].now, 0);
}

/// The calls of controls alone, the n-th of which fails.
class FailingControls {
public:
    FailingControls(Controls& controls, int fail_at, int error)
        : inner_(controls), left_(fail_at), error_(error) {}
    int ioctl(int file, unsigned long request, void* argument) {
        return --left_ == 0 ? -error_ : inner_.ioctl(file, request, argument);
    }
    bool reached() const { return left_ <= 0; }

private:
    ControlSystem inner_;
    int left_;
    int error_;
};

TEST(SetControls, SaysWhichCallFailed) {
    int runs = 0;
    for (const int error : {EINTR, EIO, ENODEV, EBUSY, EACCES})
        for (int n = 1;; ++n, ++runs) {
            Controls controls;
            FailingControls system(controls, n, error);
            std::vector<ControlSetting> settings = {setting("gain", 20), setting("auto_exposure", 1)};
            Fault fault;
            const Status got = set_controls(system, 3, {settings.data(), 2}, fault);
            if (!system.reached()) break;
            EXPECT_EQ(got == Status::ok, error == EINTR);
            if (got != Status::ok) {
                EXPECT_EQ(fault.error, error);
            }
        }
    EXPECT_GT(runs, 60);
}

}  // namespace
}  // namespace fovea::linux_port
