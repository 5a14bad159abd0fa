// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <probe/doctor_command.hpp>
#include <support/failing_system.hpp>
#include <support/json.hpp>
#include <support/pty.hpp>
#include <support/test_machine.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

const char* const recipe = R"(format = 1
name = "disc"
[locate]
part = "dark"
threshold = "fixed"
level = 128
orientation = "none"
area_min = 1000
hole_area_min = 100
[[feature]]
name = "holes"
kind = "hole_count"
nominal = 1
minus = 0
plus = 0
)";

class Doctor : public ::testing::Test {
protected:
    Doctor() {
        machine.usb("1-1", "046d", "0825", "CAFE");
        machine.camera("video0", "soc/usb1/1-1/1-1:1.0");
        machine.folder.write("etc/jobs/disc.toml", recipe);
        settings("[camera]\nrate_per_s = 25\n");
        std::fill(scene.begin() + 64 * 24, scene.end(), std::uint8_t{200});
        camera().scene = &scene;
    }
    SimulatedCamera& camera() { return machine.cameras[0]; }
    void settings(const std::string& text) { machine.folder.write("etc/fovead.toml", "format = 1\n" + text); }
    ExitCode run(Words words = {}) {
        io.hush();
        words.insert(words.begin(), {"--config", machine.folder.file("etc/fovead.toml")});
        const ExitCode code = apps::doctor_command(io, words);
        EXPECT_EQ(machine.gpio.files.size(), 0u);
        EXPECT_EQ(camera().open_handles, 0);
        return code;
    }
    /// The checks in their order: "ok camera", "FAIL mode".
    Words checks() const {
        Words all;
        for (const std::string& line : lines_of(io.out)) {
            if (line[0] == ' ') continue;
            const std::string check = line.substr(6, line.find(' ', 6) - 6);
            all.push_back(line.substr(0, line.find(' ')) + " " + check);
        }
        return all;
    }
    /// Fails at a check, with these words, and looks at nothing of the camera behind it.
    void fails(const std::string& check, const std::string& what, const std::string& next) {
        EXPECT_EQ(run(), apps::exit_not_ok);
        ASSERT_FALSE(checks().empty());
        EXPECT_EQ(checks().back(), "FAIL " + check) << io.out;
        EXPECT_TRUE(io.says(what)) << io.out;
        EXPECT_TRUE(io.says("try: " + next)) << io.out;
    }
    void warns(const std::string& check, const std::string& what, const std::string& next) {
        EXPECT_EQ(run(), apps::exit_ok) << io.out;
        const Words all = checks();
        EXPECT_EQ(std::count(all.begin(), all.end(), "warn " + check), 1) << io.out;
        EXPECT_TRUE(io.says(what)) << io.out;
        EXPECT_TRUE(io.says("try: " + next)) << io.out;
    }

    TestMachine machine;
    MachineIo<> io{machine, MachineSystem(machine)};
    std::vector<std::uint8_t> scene = std::vector<std::uint8_t>(64 * 48, 20);
};

TEST_F(Doctor, FindsNothingWhereNothingIsWrong) {
    EXPECT_EQ(run(), apps::exit_ok);
    const std::string config = machine.folder.file("etc/fovead.toml");
    EXPECT_EQ(io.out,
              "ok    settings  " + config + "\n" +
                  "ok    jobs      1, and it begins with disc\n"
                  "ok    camera    " +
                  machine.path("video0") +
                  ": simulated\n"
                  "ok    mode      gray8 (GREY) 64x48: the best of those that are fast enough\n"
                  "ok    controls  none is set: the camera chooses exposure and gain itself\n"
                  "ok    stream    it has started\n"
                  "ok    frames    30 frames, 25 a second\n"
                  "ok    stamps    frames are 0 ms old at most when they come\n"
                  "ok    light     mean 110, 50.0 % dark, 0.0 % saturated, contrast 180, sharpness 1000\n");
    EXPECT_EQ(io.errors(), "");
}

TEST_F(Doctor, TellsTheSameToAProgram) {
    EXPECT_EQ(run({"--json", "--frames", "10"}), apps::exit_ok);
    int frames = 0;
    for (const std::string& line : lines_of(io.out)) {
        const std::optional<Json> json = parse_json(line);
        ASSERT_TRUE(json) << line;
        EXPECT_EQ((*json)["result"].text, "ok");
        if ((*json)["check"].text != "frames") continue;
        ++frames;
        EXPECT_EQ((*json)["frames"].text, "10");
        EXPECT_EQ((*json)["interval_us"].text, "40000");
    }
    EXPECT_EQ(frames, 1);
    camera().unplugged = true;
    EXPECT_EQ(run({"--json"}), apps::exit_not_ok);
    const std::optional<Json> last = parse_json(lines_of(io.out).back());
    ASSERT_TRUE(last);
    EXPECT_EQ((*last)["result"].text, "fail");
    EXPECT_EQ((*last)["try"].text, "the device is gone: it is looked for again");
}

TEST_F(Doctor, LooksAtNothingWithoutSettings) {
    settings("[camera]\nwidht = 640\n");
    fails("settings", "fovead.toml:3:1: unknown key widht in camera; did you mean width?",
          "fovead --sample-config");
    EXPECT_EQ(checks(), Words{"FAIL settings"});
}

TEST_F(Doctor, LooksAtTheCameraThoughAJobIsWrong) {
    machine.folder.write("etc/jobs/disc.toml", "format = 7\n");
    EXPECT_EQ(run(), apps::exit_not_ok);
    EXPECT_EQ(checks()[1], "FAIL jobs");
    EXPECT_EQ(checks().back(), "ok light");
}

TEST_F(Doctor, MissesACamera) {
    settings("[camera]\ndevice = \"usb:1111:2222\"\n");
    fails("camera", "\"usb:1111:2222\": no device is like that", "plug it in");
    settings("[camera]\ndevice = \"usb:1\"\n");
    fails("camera", "usb: is followed by", "correct device in [camera]");
    settings("[camera]\ndevice = \"" + machine.path("video7") + "\"\n");
    fails("camera", "video7: open: No such file or directory", "it is not there: plug it in");
    machine.folder.remove("sys/class/video4linux");
    settings("");
    fails("camera", "there is no camera", "plug it in");
}

TEST_F(Doctor, SaysWhichGroupAUserNeeds) {
    machine.refused[machine.path("video0")] = EACCES;
    struct stat file {};
    ASSERT_EQ(::stat(machine.path("video0").c_str(), &file), 0);
    machine.folder.write("etc/group", "other:x:99999:\nvideo:x:" + std::to_string(file.st_gid) + ":\n");
    ASSERT_EQ(::chmod(machine.path("video0").c_str(), 0660), 0);
    fails("rights", "video0 is for the group video, and this user is not in it",
          "sudo usermod -aG video $USER");
    ASSERT_EQ(::chmod(machine.path("video0").c_str(), 0600), 0);
    fails("rights", "may not be read and written by its group video", "a udev rule");
    ASSERT_EQ(::chmod(machine.path("video0").c_str(), 0660), 0);
    machine.folder.write("proc/self/status", "Gid:\t7\nGroups:\t5 " + std::to_string(file.st_gid) + " 9 \n");
    fails("rights", "in which this user is, and yet it is refused", "a sandbox forbids it");
}

TEST_F(Doctor, NamesTheProgramThatHasTheCamera) {
    machine.program("312", "mpv", "video0");
    machine.program("7", "bash", "null");
    warns("holders", "open in mpv (process 312) too", "kill 312, if it may end");
    camera().refused_once[VIDIOC_S_FMT] = EBUSY;
    fails("mode", "VIDIOC_S_FMT: Device or resource busy: mpv (process 312) has it",
          "end it first: kill 312");
    machine.program("80", "fovead", "video0");
    warns("holders", "open in fovead (process 80) and mpv (process 312) too", "sudo systemctl stop fovead");
}

TEST_F(Doctor, MissesAMode) {
    settings("[camera]\nwidth = 800\nheight = 600\n");
    fails("mode", "the camera does not offer this size", "fovea probe lists what it offers");
    settings("[camera]\npixel_format = \"mjpeg\"\n");
    fails("mode", "the camera does not offer this format", "fovea probe lists what it offers");
    settings("[camera]\nrate_per_s = 50\n");
    warns("mode", "none is as fast as wished", "lower rate_per_s");
    EXPECT_TRUE(io.says("warn  frames    30 frames, 25 a second, and 50 are wished for")) << io.out;
}

TEST_F(Doctor, SaysWhatBecomesOfControls) {
    machine.controls = {
        {0x980913, V4L2_CTRL_TYPE_INTEGER, "Gain", 0, 100, 1, 10, 10},
        {0x9a0902, V4L2_CTRL_TYPE_INTEGER, "Exposure", 3, 2047, 1, 250, 250, V4L2_CTRL_FLAG_INACTIVE}};
    settings("[[control]]\nname = \"gain\"\nvalue = 50\n");
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_TRUE(io.says("ok    controls  1 set, and the camera has kept them"));
    EXPECT_EQ(machine.controls[0].value, 50);
    settings("[[control]]\nname = \"gain\"\nvalue = 101\n");
    fails("controls", "gain = 101: it takes 0 to 100 in steps of 1", "fovea probe lists the controls");
    settings("[[control]]\nname = \"iris\"\nvalue = 1\n");
    fails("controls", "iris = 1: the camera has no such control", "fovea probe lists the controls");
    settings("[[control]]\nname = \"exposure\"\nvalue = 9\n");
    warns("controls", "exposure = 9 has no effect while an automatic mode has the say",
          "set the automatic mode");
    machine.controls[0].kept = false;
    settings("[[control]]\nname = \"gain\"\nvalue = 60\n");
    fails("controls", "gain = 60: the camera made 50 of it", "fovea probe lists the controls");
}

TEST_F(Doctor, SaysThatNoSpaceIsAboutTheBus) {
    camera().refused_once[VIDIOC_STREAMON] = ENOSPC;
    fails("stream", "VIDIOC_STREAMON: No space left on device",
          "the USB bus has no bandwidth left: use MJPEG");
}

TEST_F(Doctor, MissesFrames) {
    camera().silent = true;
    fails("frames", "0 whole frames came, then none within 2000 ms, and 0 were damaged",
          "plug the camera in again");
}

TEST_F(Doctor, CountsDamagedAndMissingFrames) {
    camera().damaged = {0, 1, 12};
    camera().dropped = {15, 16};
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_TRUE(io.says("warn  damaged   1 frames came damaged")) << io.out;
    EXPECT_TRUE(io.says("warn  gaps      2 frames are missing in the numbering")) << io.out;
    camera().damaged = {0, 1};
    camera().dropped = {};
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_FALSE(io.says("warn")) << io.out;
}

TEST_F(Doctor, LooksAtTheTimesOfFrames) {
    camera().offered = {{V4L2_PIX_FMT_GREY, 64, 48, 200000}};
    settings("[camera]\nrate_per_s = 5\n");
    // The first of them lie in front of the start of the stream, and are not believed.
    camera().stamp_ahead_us = -600000;
    warns("stamps", "frames are 600 ms old when they come", "the machine is busy");
    camera().stamp_ahead_us = -2000000;
    warns("stamps", "the times of frames do not go forward", "triggers by a line need them");
}

TEST_F(Doctor, LooksAtTheLight) {
    std::fill(scene.begin(), scene.end(), std::uint8_t{3});
    warns("light", "mean 3, 100.0 % dark, 0.0 % saturated, contrast 0, sharpness 0: too dark",
          "take the cap off");
    std::fill(scene.begin(), scene.end(), std::uint8_t{255});
    warns("light", "mean 255, 0.0 % dark, 100.0 % saturated, contrast 0, sharpness 0: too bright",
          "expose shorter");
    std::fill(scene.begin(), scene.end(), std::uint8_t{120});
    scene[5] = 0;
    warns("light", "mean 120, 0.0 % dark, 0.0 % saturated, contrast 0, sharpness 1000: nothing stands out",
          "look at the light");
}

TEST_F(Doctor, TriesTheSerialPort) {
    Pty pty;
    machine.node("tty", "ttyUSB0", "soc/usb1/1-1/1-1:1.2/ttyUSB0");
    machine.folder.remove("dev/ttyUSB0");
    std::filesystem::create_symlink(pty.path(), machine.path("ttyUSB0"));
    settings("[serial]\ndevice = \"usb:046d:0825\"\nbaud = 9600\n");
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_EQ(checks().back(), "ok serial") << io.out;
    EXPECT_TRUE(io.says("ttyUSB0: opens with 9600 bits a second")) << io.out;

    linux_port::SerialPort<> other;
    ASSERT_EQ(other.open(pty.path()), Status::ok);
    machine.program("99", "minicom", "ttyUSB0");
    fails("serial", "minicom (process 99) has it", "end it first: kill 99");
    other.close();

    machine.refused[machine.path("ttyUSB0")] = EACCES;
    fails("serial", "ttyUSB0 may not be read and written by its group ", "a udev rule");  // but written alone
    settings("[serial]\ndevice = \"usb:0403:6001\"\n");
    fails("serial", "\"usb:0403:6001\": no device is like that", "fovea probe lists the ports");
}

TEST_F(Doctor, LooksWhetherLinesAreFreeAndTakesNone) {
    FakeGpio::Chip& chip = machine.chip("gpiochip0", "pl061", {"ready", "", "", "", "twin", "twin"});
    settings(
        "[lines]\nchip = \"pl061\"\nready = \"ready\"\nok = \"2\"\n[trigger]\nsource = \"line\"\nline = "
        "\"1\"\n");
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_EQ(checks().back(), "ok lines") << io.out;
    EXPECT_TRUE(io.says("pl061: 3 lines are there and free"));
    EXPECT_EQ(chip.lines[0].kept, 0u);
    chip.lines[2].flags = GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_OUTPUT;
    chip.lines[2].consumer = "fovea:ok";
    fails("lines", "ok = \"2\" is held by fovea:ok", "fovead has it: sudo systemctl stop fovead");
    chip.lines[1].flags = GPIO_V2_LINE_FLAG_USED;
    chip.lines[1].consumer = "button";
    fails("lines", "trigger = \"1\" is held by button", "take another line");
    settings("[lines]\nchip = \"pl061\"\nng = \"twin\"\n");
    fails("lines", "ng = \"twin\": several lines have this name", "fovea probe lists the lines");
    settings("[lines]\nchip = \"pl061\"\nng = \"9\"\n");
    fails("lines", "ng = \"9\": the chip has no line of this number", "fovea probe lists the lines");
    settings("[lines]\nchip = \"bcm\"\nng = \"9\"\n");
    fails("lines", "bcm: no GPIO chip has this label", "fovea probe lists the chips");
    settings("[trigger]\nsource = \"line\"\nline = \"1\"\n");
    fails("settings", "wants a chip in [lines]", "fovead --sample-config");
    const std::string path = machine.path("gpiochip0");
    machine.refused[path] = EACCES;
    ASSERT_EQ(::chmod(path.c_str(), 0660), 0);
    settings("[lines]\nchip = \"" + path + "\"\n");
    fails("lines", "gpiochip0 is for the group ", "sudo usermod -aG ");
}

TEST_F(Doctor, LooksAtNoCameraWherePicturesAreReplayed) {
    settings("[camera]\nreplay = \"pictures\"\n");
    warns("camera", "replay is set", "take replay out");
    EXPECT_EQ(camera().opened, 0);
}

TEST_F(Doctor, RefusesWrongWords) {
    for (const Words& words : {Words{"x"}, Words{"--frames", "0"}, Words{"--bogus"}}) {
        io.hush();
        EXPECT_EQ(apps::doctor_command(io, words), apps::exit_failed);
        EXPECT_EQ(io.out, "");
        EXPECT_EQ(io.errors().compare(0, 14, "fovea doctor: "), 0);
    }
}

TEST_F(Doctor, GivesEverythingBackWhateverCallFails) {
    machine.chip("gpiochip0", "pl061", {"GPIO4"});
    machine.program("312", "mpv", "video0");
    settings("[lines]\nchip = \"pl061\"\nready = \"0\"\n");
    const std::string config = machine.folder.file("etc/fovead.toml");
    const int runs = sweep(
        MachineSystem(machine), {ENODEV, EACCES},
        [&](FailingSystem<MachineSystem> system) {
            MachineIo<FailingSystem<MachineSystem>> failing(machine, system);
            static_cast<void>(apps::doctor_command(failing, {"--config", config, "--frames", "2"}));
        },
        [](const SystemScript& script) { EXPECT_TRUE(script.all_given_back()) << script.failed; });
    EXPECT_GT(runs, 100);
}

}  // namespace
}  // namespace fovea::test
