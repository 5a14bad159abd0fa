// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include <probe/probe_command.hpp>
#include <support/failing_system.hpp>
#include <support/json.hpp>
#include <support/test_machine.hpp>

namespace fovea::test {
namespace {

using apps::ExitCode;
using Words = std::vector<std::string>;

class Probe : public ::testing::Test {
protected:
    ExitCode run(const Words& words = {}) {
        io.hush();
        return apps::probe_command(io, words);
    }
    void webcam() {
        machine.usb("1-1", "046d", "0825", "CAFE");
        machine.camera("video0", "soc/usb1/1-1/1-1:1.0").offered = {{V4L2_PIX_FMT_MJPEG, 1280, 720, 33333},
                                                                    {V4L2_PIX_FMT_YUYV, 640, 480, 33333},
                                                                    {V4L2_PIX_FMT_YUYV, 1280, 720, 200000},
                                                                    {V4L2_PIX_FMT_H264, 1280, 720, 33333}};
        machine.descriptions[V4L2_PIX_FMT_H264] = "H.264";
        machine.camera("video1", "soc/usb1/1-1/1-1:1.0").device_caps = V4L2_CAP_META_CAPTURE;
        machine.controls = {
            {0x980900, V4L2_CTRL_TYPE_INTEGER, "Brightness", -64, 64, 2, 0, 6},
            {0x9a0901, V4L2_CTRL_TYPE_MENU, "Auto Exposure", 0, 3, 1, 3, 3},
            {0x9a0902, V4L2_CTRL_TYPE_INTEGER, "Exposure Time, Absolute", 3, 2047, 1, 250, 250,
             V4L2_CTRL_FLAG_INACTIVE},
            {0x9a0910, V4L2_CTRL_TYPE_BUTTON, "Reset (all)", 0, 0, 0, 0, 0},
            {0x9a0990, V4L2_CTRL_TYPE_INTEGER, "Temperature", 0, 99, 1, 0, 41, V4L2_CTRL_FLAG_READ_ONLY}};
    }
    std::vector<Json> lines() {
        std::vector<Json> all;
        for (const std::string& line : lines_of(io.out)) {
            const std::optional<Json> json = parse_json(line);
            EXPECT_TRUE(json) << line;
            if (json) all.push_back(*json);
        }
        return all;
    }

    TestMachine machine;
    MachineIo<> io{machine, MachineSystem(machine)};
};

TEST_F(Probe, ShowsACameraAsAPersonReadsIt) {
    webcam();
    EXPECT_EQ(run(), apps::exit_ok);
    const std::string node = machine.path("video");
    EXPECT_EQ(io.out,
              node +
                  "0: simulated\n"
                  "  device = \"usb:046d:0825:CAFE\"\n"
                  "  format  code  size      frames/s\n"
                  "  mjpeg   MJPG  1280x720  30\n"
                  "  yuyv    YUYV  640x480   30\n"
                  "  yuyv    YUYV  1280x720  5\n"
                  "  not read: H264 (H.264)\n"
                  "  chosen: mjpeg (MJPG) 1280x720 at 30 frames/s: the best of those that are fast enough\n"
                  "  control                 from  to    step  default  now\n"
                  "  brightness              -64   64    2     0        6\n"
                  "  auto_exposure           0     3     1     3        3   1 = Manual Mode and 3 = Aperture "
                  "Priority\n"
                  "  exposure_time_absolute  3     2047  1     250      250   inactive: an automatic mode "
                  "has the say\n"
                  "  reset_all               0     0     0     0        -   cannot be set\n"
                  "  temperature             0     99    1     0        41   cannot be set\n" +
                  node +
                  "1: simulated: no pictures: this node has data about pictures, not pictures: take the "
                  "camera's other node\n");
    EXPECT_EQ(io.errors(), "");
    EXPECT_EQ(machine.cameras[0].open_handles, 0);
    EXPECT_FALSE(machine.cameras[0].streaming);
}

TEST_F(Probe, SaysWhichModeAWishWouldGetAndWhy) {
    webcam();
    const auto chosen = [&](Words words) {
        EXPECT_EQ(run(words), apps::exit_ok);
        const std::size_t at = io.out.find("chosen: ");
        return io.out.substr(at + 8, io.out.find('\n', at) - at - 8);
    };
    EXPECT_EQ(chosen({"--size", "640x480"}),
              "yuyv (YUYV) 640x480 at 30 frames/s: the best of those that are fast enough");
    EXPECT_EQ(chosen({"--format", "yuyv", "--rate", "5"}),
              "yuyv (YUYV) 1280x720 at 5 frames/s: the best of those that are fast enough");
    EXPECT_EQ(chosen({"--rate", "60"}),
              "mjpeg (MJPG) 1280x720 at 30 frames/s: none is as fast as wished: the fastest");
    EXPECT_EQ(chosen({"--size=800x600"}), "none: the camera does not offer this size in such a format");
    EXPECT_EQ(chosen({"--format", "gray8"}), "none: the camera does not offer this format");
    machine.cameras[0].offered.push_back({V4L2_PIX_FMT_GREY, 640, 480, 33333});
    EXPECT_EQ(chosen({"--size", "640x480"}),
              "gray8 (GREY) 640x480 at 30 frames/s: the best of those that are fast enough");
    EXPECT_EQ(chosen({"--size", "640x480", "--colour"}),
              "yuyv (YUYV) 640x480 at 30 frames/s: the best of those that are fast enough");
    EXPECT_EQ(chosen({"--colour", "--size", "1280x720", "--rate", "4"}),
              "yuyv (YUYV) 1280x720 at 5 frames/s: the best of those that are fast enough");
}

TEST_F(Probe, ListsManyFormatsThatItCannotReadByTheirCodes) {
    auto& offered = machine.camera("video0", "soc/csi").offered;
    for (const std::uint32_t code :
         {V4L2_PIX_FMT_YVYU, V4L2_PIX_FMT_NV21, V4L2_PIX_FMT_Y16_BE, V4L2_PIX_FMT_HSV24, V4L2_PIX_FMT_H264}) {
        offered.push_back({code, 64, 48, 40000});
        machine.descriptions[code] = "a format";
    }
    EXPECT_EQ(run(), apps::exit_ok);
    EXPECT_TRUE(io.says("  not read: YVYU, NV21, Y16-BE, HSV3 and H264\n")) << io.out;
    EXPECT_EQ(run({"--json"}), apps::exit_ok);
    EXPECT_EQ(lines()[0]["not_read"].items[2].text, "Y16-BE (a format)");
}

TEST_F(Probe, TellsTheSameToAProgram) {
    webcam();
    EXPECT_EQ(run({"--json", "--size", "640x480"}), apps::exit_ok);
    const std::vector<Json> all = lines();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0]["identity"].text, "usb:046d:0825:CAFE");
    EXPECT_EQ(all[0]["pictures"].text, "true");
    ASSERT_EQ(all[0]["modes"].items.size(), 3u);
    EXPECT_EQ(all[0]["modes"].items[1]["code"].text, "YUYV");
    EXPECT_EQ(all[0]["modes"].items[1]["width"].text, "640");
    EXPECT_EQ(all[0]["modes"].items[1]["interval_us"].text, "33333");
    EXPECT_EQ(all[0]["choice"].text, "1");
    ASSERT_EQ(all[0]["controls"].items.size(), 5u);
    EXPECT_EQ(all[0]["controls"].items[2]["name"].text, "exposure_time_absolute");
    EXPECT_EQ(all[0]["controls"].items[2]["inactive"].text, "true");
    EXPECT_EQ(all[0]["controls"].items[3]["now"].kind, Json::Kind::null);
    EXPECT_EQ(all[0]["controls"].items[4]["settable"].text, "false");
    EXPECT_EQ(all[1]["pictures"].text, "false");
    EXPECT_NE(all[1]["reason"].text, "");
}

TEST_F(Probe, NamesEachCameraSoThatSettingsFindItAgain) {
    machine.usb("1-1", "046d", "0825", "CAFE");
    machine.usb("1-2", "046d", "0825", "BEEF");
    machine.usb("1-3", "1111", "2222", "");
    machine.usb("1-4", "1111", "2222", "");
    machine.usb("1-5", "3333", "4444", "");
    machine.usb("1-6", "5555", "6666", "a\tb");
    machine.camera("video0", "soc/usb1/1-1/1-1:1.0");
    machine.camera("video1", "soc/usb1/1-2/1-2:1.0");
    machine.camera("video2", "soc/usb1/1-3/1-3:1.0");
    machine.camera("video3", "soc/usb1/1-4/1-4:1.0");
    machine.camera("video4", "soc/usb1/1-5/1-5:1.0");
    machine.camera("video5", "soc/fe801000.csi");
    machine.camera("video10", "");
    machine.camera("video6", "soc/usb1/1-6/1-6:1.0");
    EXPECT_EQ(run({"--json"}), apps::exit_ok);
    Words names;
    for (const Json& camera : lines()) names.push_back(camera["identity"].text);
    EXPECT_EQ(names, (Words{"usb:046d:0825:CAFE", "usb:046d:0825:BEEF", "path:1-3:1.0", "path:1-4:1.0",
                            "usb:3333:4444", "path:fe801000.csi", "path:1-6:1.0", machine.path("video10")}));
    run();
    EXPECT_TRUE(io.says("video10\"   a number that may change"));
}

TEST_F(Probe, OfACameraWithTwoStreamsEachHasItsName) {
    machine.usb("1-1", "046d", "0825", "CAFE");
    machine.camera("video0", "soc/usb1/1-1/1-1:1.0").device_caps = V4L2_CAP_META_CAPTURE;
    machine.camera("video1", "soc/usb1/1-1/1-1:1.0");
    machine.camera("video2", "soc/usb1/1-1/1-1:1.2");
    EXPECT_EQ(run({"--json"}), apps::exit_ok);
    const std::vector<Json> all = lines();
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[1]["identity"].text, "usb:046d:0825:CAFE");
    EXPECT_EQ(all[2]["identity"].text, "path:1-1:1.2");
}

TEST_F(Probe, SaysWhyANodeCannotBeUsed) {
    machine.camera("video0", "soc/csi").offered = {{V4L2_PIX_FMT_SRGGB10P, 3280, 2464, 66666}};
    machine.descriptions[V4L2_PIX_FMT_SRGGB10P] = "10-bit Bayer RGRG/GBGB Packed";
    machine.camera("video1", "soc/usb1");
    machine.refused[machine.path("video1")] = EACCES;
    EXPECT_EQ(run(), apps::exit_not_ok);
    EXPECT_TRUE(io.says(
        "no pictures: its formats cannot be read: pRAA (10-bit Bayer RGRG/GBGB Packed); these are raw "
        "pictures of a sensor"))
        << io.out;
    EXPECT_TRUE(io.says("video1: no pictures: open: Permission denied; this user has no right to it"))
        << io.out;
    EXPECT_TRUE(io.says("no camera: "));
}

TEST_F(Probe, ListsSerialPortsThatHaveHardware) {
    machine.usb("1-1", "0403", "6001", "A50285BI");
    machine.usb("1-2", "0403", "6010", "");
    machine.node("tty", "ttyUSB10", "soc/usb1/1-1/1-1:1.0/ttyUSB10");
    machine.node("tty", "ttyUSB0", "soc/usb1/1-2/1-2:1.0/ttyUSB0");
    machine.node("tty", "ttyUSB1", "soc/usb1/1-2/1-2:1.1/ttyUSB1");
    machine.node("tty", "ttyS0", "platform/serial8250");
    machine.node("tty", "ttyS1", "platform/fe201000.serial");
    machine.node("tty", "tty0", "");
    machine.folder.write("sys/class/tty/ttyS0/type", "0\n");
    machine.folder.write("sys/class/tty/ttyS1/type", "4\n");
    EXPECT_EQ(run({"--json"}), apps::exit_not_ok);
    Words names;
    for (const Json& port : lines()) names.push_back(port["node"].text + " " + port["identity"].text);
    EXPECT_EQ(names,
              (Words{machine.path("ttyS1") + " path:fe201000.serial",
                     machine.path("ttyUSB0") + " path:1-2:1.0", machine.path("ttyUSB1") + " path:1-2:1.1",
                     machine.path("ttyUSB10") + " usb:0403:6001:A50285BI"}));
}

TEST_F(Probe, ListsTheLinesOfChipsWithTheirHolders) {
    FakeGpio::Chip& chip = machine.chip("gpiochip0", "9030000.pl061", {"GPIO4", "", ""});
    chip.lines[0].consumer = "power button";
    chip.lines[0].flags = GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_INPUT;
    chip.lines[2].flags = GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_OUTPUT;
    machine.chip("gpiochip1", "other", {});
    machine.refused[machine.path("gpiochip1")] = EACCES;
    run();
    EXPECT_TRUE(
        io.says("gpiochip0: 9030000.pl061, 3 lines\n"
                "  chip = \"9030000.pl061\"\n"
                "  line  name   direction  held by\n"
                "  0     GPIO4  input      power button\n"
                "  1     -      input\n"
                "  2     -      output     the kernel\n"))
        << io.out;
    EXPECT_TRUE(io.says("gpiochip1: open: Permission denied; this user has no right to it")) << io.out;
    run({"--json"});
    const std::vector<Json> all = lines();
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[0]["lines"].items[0]["held_by"].text, "power button");
    EXPECT_EQ(all[0]["lines"].items[1]["held_by"].kind, Json::Kind::null);
    EXPECT_NE(all[1]["reason"].text, "");
    EXPECT_TRUE(machine.gpio.files.empty());
}

TEST_F(Probe, EndsWithOneWithoutACameraAndWithTwoIfItCouldNotLook) {
    EXPECT_EQ(run(), apps::exit_not_ok);
    EXPECT_EQ(io.out, "no camera: plug one in, and look whether dmesg tells of it\n");
    EXPECT_EQ(run({"--json"}), apps::exit_not_ok);
    EXPECT_EQ(io.out, "");
    machine.folder.write("sys/class/video4linux", "a file where a folder should be");
    EXPECT_EQ(run(), apps::exit_failed);
    EXPECT_EQ(io.out, "");
    EXPECT_NE(io.errors().find("/class/video4linux: open: Not a directory"), std::string::npos)
        << io.errors();
}

TEST_F(Probe, RefusesWrongWords) {
    const auto refuses = [&](const Words& words, const std::string& complaint) {
        EXPECT_EQ(run(words), apps::exit_failed);
        EXPECT_EQ(io.errors(), "fovea probe: " + complaint + "\n");
        EXPECT_EQ(io.out, "");
    };
    refuses({"/dev/video0"}, "it takes no words, not '/dev/video0'");
    refuses({"--size", "640"}, "--size takes WIDTHxHEIGHT, not '640'");
    refuses({"--size", "0x480"}, "--size takes WIDTHxHEIGHT, not '0x480'");
    refuses({"--size", "640x48000"}, "--size takes WIDTHxHEIGHT, not '640x48000'");
    refuses({"--rate", "0"}, "--rate takes a whole number from 1 to 10000, not '0'");
    EXPECT_EQ(run({"--format", "yuv"}), apps::exit_failed);
    EXPECT_NE(io.errors().find("not 'yuv'; did you mean yuyv?"), std::string::npos) << io.errors();
}

TEST_F(Probe, GivesEverythingBackWhateverCallFails) {
    webcam();
    machine.chip("gpiochip0", "pl061", {"GPIO4"});
    const int runs = sweep(
        MachineSystem(machine), {ENODEV, EACCES},
        [&](FailingSystem<MachineSystem> system) {
            MachineIo<FailingSystem<MachineSystem>> failing(machine, system);
            const ExitCode code = apps::probe_command(failing, {});
            EXPECT_GE(code, apps::exit_ok);
            EXPECT_LE(code, apps::exit_failed);
        },
        [](const SystemScript& script) { EXPECT_TRUE(script.all_given_back()) << script.failed; });
    EXPECT_GT(runs, 100);
}

}  // namespace
}  // namespace fovea::test
