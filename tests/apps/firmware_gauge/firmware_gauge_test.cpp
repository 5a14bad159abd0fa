// SPDX-License-Identifier: MIT
//
// The firmware on simulated ports: what the emulated boards cannot do, such as a broken pin. All the rest is
// in tests/target/firmware.py.
#include <gtest/gtest.h>

#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include <fovea/codec/packet.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <fovea/draw/rectangle.hpp>
#include <fovea/simulated/byte_pipe.hpp>
#include <fovea/simulated/pins.hpp>
#include <fovea/simulated/watchdog.hpp>

#include <firmware_gauge/firmware_gauge.hpp>
#include <support/recipes.hpp>

namespace fovea::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Ports = apps::FirmwarePorts<simulated::BytePipe, simulated::Pin, simulated::Pin, simulated::Clock,
                                  simulated::Watchdog>;
using Memory = apps::GaugeMemory<6000, 30000, 200, 2, 2>;

constexpr Size frame_size{80, 60};

/// A plate of 40 x 20 px is OK.
RecipeOf<2> plate_recipe() {
    RecipeOf<2> recipe;
    set_name(recipe.name, "plate \"a\"");
    recipe.locate.orientation = OrientationRule::none;
    Feature width;
    set_name(width.name, "width");
    width.from = {-30000000, 0};
    width.to = {30000000, 0};
    width.lines = 5;
    width.tolerance = {Decimal::from_int(40), {500000}, {500000}};
    EXPECT_EQ(recipe.features.push(width), Status::ok);
    return recipe;
}

class FirmwareGauge : public ::testing::Test {
protected:
    FirmwareGauge() { firmware.start(); }

    void send(apps::PacketKind kind, std::initializer_list<int> numbers = {}, const Bytes& rest = {}) {
        Bytes content = {static_cast<std::uint8_t>(kind)};
        for (const int number : numbers) {
            content.push_back(static_cast<std::uint8_t>(number & 255));
            content.push_back(static_cast<std::uint8_t>(number >> 8));
        }
        content.insert(content.end(), rest.begin(), rest.end());
        Bytes line(1000);
        const auto size = encode_packet({content.data(), static_cast<std::ptrdiff_t>(content.size())},
                                        {line.data(), static_cast<std::ptrdiff_t>(line.size())});
        ASSERT_TRUE(size.ok());
        serial.arriving.insert(serial.arriving.end(), line.begin(), line.begin() + *size);
    }
    void send_recipe() {
        Bytes bytes(1000);
        const auto size = encode_recipe(plate_recipe(), {bytes.data(), 1000});
        ASSERT_TRUE(size.ok());
        bytes.resize(static_cast<std::size_t>(*size));
        send(apps::PacketKind::recipe, {}, bytes);
    }
    /// A frame with dark plates.
    void send_frame(std::initializer_list<Rectangle> plates) {
        Bytes pixels(static_cast<std::size_t>(frame_size.area()), 200);
        const ImageView<Gray8> image(pixels.data(), frame_size, frame_size.width);
        for (const Rectangle& plate : plates) EXPECT_EQ(fill_rectangle(image, plate, Gray8{30}), Status::ok);
        send(apps::PacketKind::frame, {frame_size.width, frame_size.height});
        for (int y = 0; y < frame_size.height; ++y)
            send(apps::PacketKind::line, {y}, Bytes(image.row(y), image.row(y) + frame_size.width));
    }
    /// Turns until all has been read; what was said meanwhile.
    std::string said() {
        do firmware.turn();
        while (!serial.arriving.empty() && !serial.broken);
        const std::string text(serial.sent.begin(), serial.sent.end());
        serial.sent.clear();
        return text;
    }
    bool is(bool ok_active, bool not_ok_active) {
        return *ok.active() == ok_active && *not_ok.active() == not_ok_active;
    }

    simulated::BytePipe serial;
    simulated::Pin trigger, ok, not_ok;
    simulated::Clock clock;
    simulated::Watchdog watchdog{clock, 3000000};
    std::unique_ptr<Memory> memory = std::make_unique<Memory>();
    apps::GaugeJob<Memory> job{*memory};
    apps::FrameFirmware<Ports, apps::GaugeJob<Memory>> firmware{
        Ports{serial, trigger, ok, not_ok, clock, watchdog}, job, "bench"};
};

TEST_F(FirmwareGauge, SaysWhatItIsAndWhatItTakes) {
    EXPECT_EQ(
        said(),
        "{\"board\":\"bench\",\"recipe\":null,\"features\":0,\"frame_bytes\":6000,\"line_bytes\":200}\n");
    send_recipe();
    EXPECT_EQ(said(),
              "{\"board\":\"bench\",\"recipe\":\"plate "
              "\\\"a\\\"\",\"features\":1,\"frame_bytes\":6000,\"line_bytes\":200}\n");
}

TEST_F(FirmwareGauge, JudgesAFrameBehindAnEdge) {
    send_recipe();
    said();
    ASSERT_EQ(trigger.set(true), Status::ok);
    EXPECT_EQ(said(), "{\"frame\":1,\"ready\":true}\n");
    send_frame({{20, 20, 40, 20}});
    EXPECT_EQ(
        said(),
        "{\"frame\":1,\"parts\":[{\"x\":39.500,\"y\":29.500,\"angle_deg\":0.0000,\"area_px\":800,\"holes\":0,"
        "\"features\":[{\"name\":\"width\",\"value\":40.000000,\"verdict\":\"ok\"}],\"verdict\":\"ok\"}],"
        "\"verdict\":\"ok\"}\n");
    EXPECT_TRUE(is(true, false));
    // The next trigger takes the verdict back.
    send(apps::PacketKind::trigger);
    said();
    EXPECT_TRUE(is(false, false));
    send_frame({{20, 20, 38, 20}});
    EXPECT_NE(said().find("\"verdict\":\"low\"}],\"verdict\":\"not_ok\"}],\"verdict\":\"not_ok\"}"),
              std::string::npos);
    EXPECT_TRUE(is(false, true));
}

TEST_F(FirmwareGauge, IsNotOkIfOneOfTwoPartsIsNotAndJudgesNoneOfThree) {
    send_recipe();
    send(apps::PacketKind::trigger);
    send_frame({{20, 5, 40, 20}, {20, 35, 37, 20}});
    const std::string two = said();
    EXPECT_NE(two.find("},{\"x\":"), std::string::npos);
    EXPECT_TRUE(is(false, true));
    send(apps::PacketKind::trigger);
    send_frame({{20, 3, 40, 14}, {20, 23, 40, 14}, {20, 43, 40, 14}});
    EXPECT_NE(said().find("\"error\":\"more entries than the list can hold\""), std::string::npos);
    EXPECT_TRUE(is(false, false));
}

TEST_F(FirmwareGauge, AWidthThatIsNotThereIsNeitherOkNorNot) {
    send_recipe();
    send(apps::PacketKind::trigger);
    send_frame({{9, 20, 62, 20}});  // the probe of 60 px begins inside it
    const std::string text = said();
    EXPECT_NE(text.find("\"value\":null,\"reason\":\"nothing found\",\"verdict\":\"unmeasured\""),
              std::string::npos)
        << text;
    EXPECT_TRUE(is(false, false));
}

TEST_F(FirmwareGauge, AStuckLineStopsNoVerdict) {
    send_recipe();
    said();
    serial.room = 0;
    send(apps::PacketKind::trigger);
    send_frame({{20, 20, 40, 20}});
    // Time passes while it waits for room.
    clock.step = 1000;
    EXPECT_EQ(said(), "");
    EXPECT_TRUE(is(true, false));
    EXPECT_FALSE(watchdog.barks());
    // Three letters of a line, and then no more: the next line is a line of its own.
    serial.room = 3;
    send(apps::PacketKind::trigger);
    EXPECT_EQ(said(), "\n{\"");
    serial.room = 1 << 20;
    send(apps::PacketKind::state);
    EXPECT_EQ(said().rfind("\n{\"board\":\"bench\"", 0), 0u);
}

TEST_F(FirmwareGauge, TellsOfPinsThatDoNotObey) {
    send_recipe();
    said();
    not_ok.broken = true;
    send(apps::PacketKind::trigger);
    EXPECT_NE(said().find("{\"error\":\"a verdict's pin cannot be set\"}"), std::string::npos);
    not_ok.broken = false;
    trigger.broken = true;
    EXPECT_NE(said().find("\"error\":\"the trigger cannot be read\""), std::string::npos);
    EXPECT_TRUE(is(false, false));
    // Once, and a packet still triggers.
    EXPECT_EQ(said(), "");
    send(apps::PacketKind::trigger);
    EXPECT_EQ(said(), "{\"frame\":2,\"ready\":true}\n");
}

TEST_F(FirmwareGauge, TellsOfAPacketWithoutEndOnce) {
    said();
    for (const std::size_t bytes : {std::size_t{5}, std::size_t{1000}}) {
        serial.arriving.push_back(0xC0);
        serial.arriving.insert(serial.arriving.end(), bytes, 1);
        clock.now += 1000;
        const std::string at_once = said();
        clock.now += 2500000;
        EXPECT_EQ(at_once + said(), bytes == 5
                                        ? "{\"error\":\"packet cut off\",\"verdict\":\"unmeasured\"}\n"
                                        : "{\"error\":\"packet too long\",\"verdict\":\"unmeasured\"}\n");
        for (int i = 0; i < 3; ++i) {
            clock.now += 2500000;
            EXPECT_EQ(said(), "");
        }
    }
    // So is a trigger without a frame.
    send_recipe();
    send(apps::PacketKind::trigger);
    said();
    clock.now += 2500000;
    EXPECT_EQ(said(), "{\"frame\":1,\"error\":\"no frame came\",\"verdict\":\"unmeasured\"}\n");
    clock.now += 2500000;
    EXPECT_EQ(said(), "");
}

TEST_F(FirmwareGauge, NamesALineOnlyWhereALineIsWrong) {
    send_recipe();
    said();
    send(apps::PacketKind::trigger);
    said();
    send_frame({});
    EXPECT_EQ(said(),
              "{\"frame\":1,\"error\":\"the data do not determine an answer\",\"verdict\":\"unmeasured\"}\n");
    send(apps::PacketKind::trigger);
    send(apps::PacketKind::frame, {frame_size.width, frame_size.height});
    send(apps::PacketKind::line, {1}, Bytes(static_cast<std::size_t>(frame_size.width), 9));
    EXPECT_NE(said().find("\"error\":\"line missing\",\"line\":0,"), std::string::npos);
}

TEST_F(FirmwareGauge, ABrokenLineIsOutwaited) {
    send_recipe();
    send(apps::PacketKind::trigger);
    said();
    serial.broken = true;
    clock.now += 2500000;
    said();
    serial.broken = false;
    EXPECT_TRUE(is(false, false));
    send(apps::PacketKind::trigger);
    EXPECT_NE(said().find("\"ready\":true"), std::string::npos);
}

TEST_F(FirmwareGauge, FeedsItsWatchdogWithEveryTurn) {
    for (int i = 0; i < 10; ++i) {
        clock.now += 2900000;
        said();
    }
    EXPECT_FALSE(watchdog.barks());
    clock.now += 3100000;
    EXPECT_TRUE(watchdog.barks());
}

}  // namespace
}  // namespace fovea::test
