// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fovea/base/list.hpp>
#include <fovea/linux/device_identity.hpp>
#include <support/failing_system.hpp>

namespace fovea::test {
namespace {

namespace files = std::filesystem;
using linux_port::DevicePath;
using Paths = std::vector<std::string>;

void write_line(const files::path& path, const std::string& line) {
    files::create_directories(path.parent_path());
    std::ofstream(path) << line << '\n';
}

/// A board with four serial adapters (two of one kind; one with two ports; a modem), a UART of its own, a
/// webcam with two nodes, and a camera without USB; as Linux shows it in /sys and /dev.
struct Board {
    Board() {
        std::string pattern = (files::temp_directory_path() / "fovea_sysfs_XXXXXX").string();
        folder = ::mkdtemp(pattern.data());
        usb("1-1", "0403", "6001", "A50285BI");
        usb("1-2", "0403", "6001", "A10XYZ:7");
        usb("1-3", "0403", "6010", "");
        usb("1-4", "2341", "0043", "85 43");
        usb("1-1.2", "046d", "0825", "CAFE");
        node("tty", "ttyUSB10", usb_place + "1-1/1-1:1.0/ttyUSB10");
        node("tty", "ttyUSB2", usb_place + "1-2/1-2:1.0/ttyUSB2");
        node("tty", "ttyUSB3", usb_place + "1-3/1-3:1.0/ttyUSB3");
        node("tty", "ttyUSB4", usb_place + "1-3/1-3:1.1/ttyUSB4");
        node("tty", "ttyACM0", usb_place + "1-4/1-4:1.0");
        node("tty", "ttyAMA0", "platform/soc/fe201000.serial");
        node("video4linux", "video0", usb_place + "1-1.2/1-1.2:1.0");
        node("video4linux", "video1", usb_place + "1-1.2/1-1.2:1.0");
        node("video4linux", "video2", "platform/soc/fe801000.csi");
        // A terminal without a device, and what is no device at all.
        files::create_directories(folder / "sys/devices/virtual/tty/tty0");
        files::create_directory_symlink("../../devices/virtual/tty/tty0", folder / "sys/class/tty/tty0");
        write_line(folder / "sys/class/tty/active", "tty0");
        write_line(folder / "dev/serial/by-path/platform-xhci-usb-0:1:1.0-port0", "");
    }
    ~Board() { files::remove_all(folder); }

    void usb(const std::string& place, const std::string& vendor, const std::string& product,
             const std::string& serial) {
        const files::path device = folder / "sys/devices" / (usb_place + place);
        write_line(device / "idVendor", vendor);
        write_line(device / "idProduct", product);
        if (!serial.empty()) write_line(device / "serial", serial);
    }
    void node(const std::string& kind, const std::string& name, const std::string& device) {
        const files::path place = folder / "sys/devices" / device / kind / name;
        files::create_directories(place);
        files::create_directory_symlink("../..", place / "device");
        files::create_directories(folder / "sys/class" / kind);
        files::create_directory_symlink("../../devices/" + device + "/" + kind + "/" + name,
                                        folder / "sys/class" / kind / name);
    }

    files::path folder;
    const std::string usb_place = "platform/soc/xhci/usb1/";
};

struct DeviceIdentity : testing::Test {
    /// The nodes, or what is wrong.
    Paths nodes(const std::string& kind, const std::string& identity) {
        List<DevicePath, 16> list;
        const Status status = finder.find(kind.c_str(), identity.c_str(), list);
        if (status != Status::ok) return {describe(status)};
        Paths all;
        for (const DevicePath& path : list) {
            const std::string text = path.c_str();
            all.push_back(text.find(dev) == 0 ? text.substr(dev.size()) : text);
        }
        return all;
    }
    Paths tty(const std::string& identity) { return nodes("tty", identity); }

    Board board;
    const std::string sys = (board.folder / "sys").string(), dev = (board.folder / "dev/").string();
    const std::string dev_folder = (board.folder / "dev").string();
    linux_port::DeviceFinder<> finder{{}, {sys.c_str(), dev_folder.c_str()}};
    const Paths none = {describe(Status::not_found)};
    const Paths refused = {describe(Status::bad_argument)};
};

TEST_F(DeviceIdentity, IsAPathAsItIs) {
    EXPECT_EQ(tty("/dev/ttyUSB7"), Paths{"/dev/ttyUSB7"}) << "whether it is there, its opening says";
    EXPECT_EQ(tty("/dev/serial/by-id/usb-FTDI-port0"), Paths{"/dev/serial/by-id/usb-FTDI-port0"});
    EXPECT_EQ(tty("/" + std::string(190, 'x')), Paths{"/" + std::string(190, 'x')});
    EXPECT_EQ(tty("/" + std::string(191, 'x')), refused);
    for (const char* other : {"", "ttyUSB0", "dev/ttyUSB0", "USB:0403:6001", "autos", " auto"})
        EXPECT_EQ(tty(other), refused) << other;
}

TEST_F(DeviceIdentity, IsVendorAndProductOfUsb) {
    EXPECT_EQ(tty("usb:2341:0043"), Paths{"ttyACM0"});
    EXPECT_EQ(tty("usb:0403:6001"), (Paths{"ttyUSB2", "ttyUSB10"}));
    EXPECT_EQ(tty("usb:0403:6010"), (Paths{"ttyUSB3", "ttyUSB4"}));
    EXPECT_EQ(tty("usb:0403:6011"), none);
    EXPECT_EQ(tty("usb:0404:6001"), none);
    EXPECT_EQ(tty("usb:046d:0825"), none) << "that is the camera";
    EXPECT_EQ(nodes("video4linux", "usb:046d:0825"), (Paths{"video0", "video1"}));
    EXPECT_EQ(nodes("video4linux", "usb:046D:0825:CAFE"), (Paths{"video0", "video1"}));
    EXPECT_EQ(nodes("sound", "usb:046d:0825"), none) << "no such class here";
}

TEST_F(DeviceIdentity, IsASerialNumber) {
    EXPECT_EQ(tty("usb:0403:6001:A50285BI"), Paths{"ttyUSB10"});
    EXPECT_EQ(tty("usb:0403:6001:A10XYZ:7"), Paths{"ttyUSB2"});
    EXPECT_EQ(tty("usb:2341:0043:85 43"), Paths{"ttyACM0"});
    EXPECT_EQ(tty("usb:0403:6001:A50285B"), none);
    EXPECT_EQ(tty("usb:0403:6001:a50285bi"), none);
    EXPECT_EQ(tty("usb:0403:6010:1"), none) << "it has none";
    for (const char* bad :
         {"usb:", "usb:0403", "usb:0403:", "usb:0403:600", "usb:0403:60011",
          "usb:0403:6001:", "usb:0403-6001", "usb:040g:6001", "usb:403:6001", "usb:0403:6001-A"})
        EXPECT_EQ(tty(bad), refused) << bad;
}

TEST_F(DeviceIdentity, IsAPlace) {
    EXPECT_EQ(tty("path:platform-xhci-usb-0:1:1.0-port0"),
              Paths{"serial/by-path/platform-xhci-usb-0:1:1.0-port0"});
    EXPECT_EQ(tty("path:1-1:1.0"), Paths{"ttyUSB10"});
    EXPECT_EQ(tty("path:1-3"), (Paths{"ttyUSB3", "ttyUSB4"}));
    EXPECT_EQ(tty("path:1-3/1-3:1.1"), Paths{"ttyUSB4"});
    EXPECT_EQ(tty("path:1-3:1"), none) << "parts as a whole";
    EXPECT_EQ(tty("path:-3"), none);
    EXPECT_EQ(tty("path:fe201000.serial"), Paths{"ttyAMA0"});
    EXPECT_EQ(nodes("video4linux", "path:fe801000.csi"), Paths{"video2"});
    EXPECT_EQ(nodes("video4linux", "path:platform-xhci-usb-0:1:1.0-port0"), none)
        << "a place of another class";
    EXPECT_EQ(nodes("video4linux", "path:1-1.2"), (Paths{"video0", "video1"}));
    EXPECT_EQ(tty("path:"), refused);
    EXPECT_EQ(tty("path:nothing"), none);
}

TEST_F(DeviceIdentity, IsAnyThatHasADevice) {
    EXPECT_EQ(nodes("video4linux", "auto"), (Paths{"video0", "video1", "video2"}));
    EXPECT_EQ(tty("auto"), (Paths{"ttyACM0", "ttyAMA0", "ttyUSB2", "ttyUSB3", "ttyUSB4", "ttyUSB10"}));
}

TEST_F(DeviceIdentity, IsOneNodeOrUndecided) {
    DevicePath path("before");
    EXPECT_EQ(finder.resolve("tty", "usb:0403:6001", path), Status::undecided);
    EXPECT_STREQ(finder.fault().about,
                 "several devices are like that: add the serial number, or write path:");
    EXPECT_EQ(finder.resolve("tty", "usb:0403:6011", path), Status::not_found);
    EXPECT_EQ(finder.resolve("tty", "nothing", path), Status::bad_argument);
    EXPECT_STREQ(path.c_str(), "before");
    EXPECT_EQ(finder.resolve("tty", "usb:0403:6001:A50285BI", path), Status::ok);
    EXPECT_EQ(path.c_str(), dev + "ttyUSB10");
}

TEST_F(DeviceIdentity, HasTheFirstWhereThereIsNoRoomForAll) {
    List<DevicePath, 2> list;
    EXPECT_EQ(finder.find("tty", "auto", list), Status::capacity_exceeded);
    ASSERT_EQ(list.size(), 2);
    EXPECT_EQ(list[0].c_str(), dev + "ttyACM0");
    EXPECT_EQ(list[1].c_str(), dev + "ttyAMA0");
}

/// F2: the adapter comes back under another number.
TEST_F(DeviceIdentity, IsLookedForAnew) {
    const std::string place = board.usb_place + "1-4/1-4:1.0/tty/";
    files::remove(board.folder / "sys/class/tty/ttyACM0");
    files::remove_all(board.folder / "sys/devices" / place);
    EXPECT_EQ(tty("usb:2341:0043"), none);
    board.node("tty", "ttyACM1", board.usb_place + "1-4/1-4:1.0");
    EXPECT_EQ(tty("usb:2341:0043"), Paths{"ttyACM1"});
}

TEST_F(DeviceIdentity, DoesWithoutSysfs) {
    linux_port::DeviceFinder<> blind({}, {"/nowhere", "/dev"});
    List<DevicePath, 2> list;
    EXPECT_EQ(blind.find("tty", "auto", list), Status::not_found);
    EXPECT_STREQ(blind.fault().call, "open");
    EXPECT_EQ(blind.find("tty", "/dev/ttyS0", list), Status::ok);
}

TEST_F(DeviceIdentity, EndsEverySweepWithAnAnswerThatIsTrue) {
    const std::vector<std::string> identities = {"usb:0403:6001:A50285BI", "path:1-1:1.0",
                                                 "path:platform-xhci-usb-0:1:1.0-port0"};
    int runs = 0, found = 0;
    for (const std::string& identity : identities) {
        const bool link = identity.size() > 30;
        const std::string right = link ? "serial/by-path/" + identity.substr(5) : "ttyUSB10";
        std::string claim;
        runs += sweep(
            linux_port::Kernel{}, {EINTR, EIO, ENODEV, ENOENT, EACCES, EMFILE},
            [&](auto system) {
                linux_port::DeviceFinder swept(system, {sys.c_str(), dev_folder.c_str()});
                DevicePath path("before");
                const Status status = swept.resolve("tty", identity.c_str(), path);
                if (status == Status::ok) {
                    ++found;
                    if (path.c_str() != dev + right) claim = std::string("another device: ") + path.c_str();
                } else if (std::string(path.c_str()) != "before" || swept.fault().status != status) {
                    claim = describe(status);
                }
            },
            [&](const SystemScript& script) {
                ASSERT_TRUE(script.all_given_back()) << identity << script.fail_at;
                ASSERT_EQ(claim, "") << identity << script.fail_at << " " << script.error;
            });
    }
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 500);
    EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace fovea::test
