// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/linux/gpio.hpp>
#include <support/failing_system.hpp>
#include <support/fake_gpio_chip.hpp>

namespace fovea::test {
namespace {

using linux_port::LineBias;
using linux_port::LineDrive;
using linux_port::LineEdge;
using linux_port::LineEdges;
using linux_port::LineLevel;

struct Gpio : testing::Test {
    Gpio() {
        fake.chips = {{"gpiochip0", "9030000.pl061", std::vector<FakeGpio::Line>(8)}};
        fake.line(0, 3).consumer = "GPIO Key Poweroff";
        fake.line(0, 3).flags = GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_INPUT;
        fake.line(0, 5).name = "TRIGGER";
        EXPECT_EQ(chip.open("pl061"), Status::ok);
    }

    FakeGpio fake;
    FakeGpioSystem system{&fake};
    linux_port::GpioChip<FakeGpioSystem> chip{system};
    linux_port::OutputLine<FakeGpioSystem> output{system};
    linux_port::InputLine<FakeGpioSystem> input{system};
};

TEST_F(Gpio, DrivesALine) {
    for (const LineLevel level : {LineLevel::high, LineLevel::low}) {
        const bool high = level == LineLevel::high;
        // Whatever it was before.
        fake.line(0, 1).high = high;
        ASSERT_EQ(output.open(chip, "1", "ok", {level}), Status::ok);
        EXPECT_EQ(fake.line(0, 1).high, !high) << "inactive from the beginning";
        EXPECT_EQ(fake.line(0, 1).consumer, "fovea:ok");
        for (const bool active : {true, true, false, true}) {
            ASSERT_EQ(output.set(active), Status::ok);
            EXPECT_EQ(fake.line(0, 1).high, active == high);
            EXPECT_EQ(output.active().value(), active);
        }
    }
}

TEST_F(Gpio, AsksForWhatTheOptionsSay) {
    ASSERT_EQ(output.open(chip, "1", "ok", {LineLevel::high, LineDrive::open_drain}), Status::ok);
    EXPECT_EQ(fake.line(0, 1).flags,
              GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_OUTPUT | GPIO_V2_LINE_FLAG_OPEN_DRAIN);
    ASSERT_EQ(output.open(chip, "1", "ok", {LineLevel::low, LineDrive::open_source}), Status::ok);
    EXPECT_EQ(fake.line(0, 1).flags, GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_OUTPUT |
                                         GPIO_V2_LINE_FLAG_OPEN_SOURCE | GPIO_V2_LINE_FLAG_ACTIVE_LOW);
    const std::uint64_t in = GPIO_V2_LINE_FLAG_USED | GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING;
    const std::pair<LineBias, std::uint64_t> biases[] = {
        {LineBias::as_found, 0},
        {LineBias::none, GPIO_V2_LINE_FLAG_BIAS_DISABLED},
        {LineBias::pull_up, GPIO_V2_LINE_FLAG_BIAS_PULL_UP},
        {LineBias::pull_down, GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN}};
    for (const auto& [bias, flag] : biases) {
        ASSERT_EQ(input.open(chip, "TRIGGER", "trigger", {LineLevel::high, bias}), Status::ok);
        EXPECT_EQ(fake.line(0, 5).flags, in | flag);
        EXPECT_EQ(fake.line(0, 5).debounce_us, 0u);
    }
    ASSERT_EQ(input.open(chip, "5", "t", {LineLevel::low, LineBias::as_found, 5000, LineEdges::both, 100}),
              Status::ok);
    EXPECT_EQ(fake.line(0, 5).flags, in | GPIO_V2_LINE_FLAG_EDGE_FALLING | GPIO_V2_LINE_FLAG_ACTIVE_LOW);
    EXPECT_EQ(fake.line(0, 5).debounce_us, 5000u);
    EXPECT_EQ(fake.line(0, 5).kept, 100u);
}

TEST_F(Gpio, HasAHolderOfAtMost31Bytes) {
    ASSERT_EQ(output.open(chip, "1", "a role that is far too long for it"), Status::ok);
    EXPECT_EQ(fake.line(0, 1).consumer, "fovea:a role that is far too lo");
    EXPECT_EQ(fake.line(0, 1).consumer.size(), 31u);
}

/// F16.
TEST_F(Gpio, NamesWhoHasALine) {
    EXPECT_EQ(input.open(chip, "3", "trigger"), Status::io_error);
    EXPECT_STREQ(input.holder(), "GPIO Key Poweroff");
    EXPECT_EQ(input.fault().error, EBUSY);
    EXPECT_STREQ(input.fault().call, "GPIO_GET_LINE");
    EXPECT_STREQ(input.fault().about, "GPIO Key Poweroff");
    EXPECT_FALSE(input.is_open());
    // Our own lines have one, too, and only as long as they are open.
    ASSERT_EQ(output.open(chip, "1", "ok"), Status::ok);
    EXPECT_EQ(input.open(chip, "1", "trigger"), Status::io_error);
    EXPECT_STREQ(input.holder(), "fovea:ok");
    output.close();
    EXPECT_EQ(input.open(chip, "1", "trigger"), Status::ok);
    EXPECT_STREQ(input.holder(), "");
}

TEST_F(Gpio, SaysThatThereIsNoSuchLine) {
    EXPECT_EQ(output.open(chip, "8", "ok"), Status::not_found);
    EXPECT_EQ(output.open(chip, "NOTHING", "ok"), Status::not_found);
    EXPECT_STREQ(output.fault().about, "the chip has no line of this name");
    EXPECT_EQ(output.set(true), Status::device_lost) << "it is not open";
    EXPECT_EQ(output.active().status(), Status::device_lost);
    LineEdge edge;
    EXPECT_EQ(input.next_edge(edge), Status::device_lost);
    EXPECT_EQ(input.take_edge().status(), Status::device_lost);
}

TEST_F(Gpio, SeesTheLevelOfALine) {
    for (const LineLevel level : {LineLevel::high, LineLevel::low})
        for (const bool high : {true, false}) {
            ASSERT_EQ(input.open(chip, "5", "trigger", {level}), Status::ok);
            fake.drive(0, 5, high);
            EXPECT_EQ(input.active().value(), high == (level == LineLevel::high));
        }
}

TEST_F(Gpio, RemembersThatALineBecameActive) {
    fake.pulse(0, 5);
    ASSERT_EQ(input.open(chip, "TRIGGER", "trigger"), Status::ok);
    EXPECT_EQ(input.take_edge().value(), false) << "what happened before is not told";
    fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true);
    EXPECT_EQ(input.take_edge().value(), false);
    for (int i = 0; i < 5; ++i) fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true) << "several count once";
    EXPECT_EQ(input.take_edge().value(), false);
    fake.drive(0, 5, true);
    EXPECT_EQ(input.take_edge().value(), true);
    fake.drive(0, 5, false);
    EXPECT_EQ(input.take_edge().value(), false);
    // Where both edges are told, only the active one counts.
    ASSERT_EQ(input.open(chip, "5", "t", {LineLevel::low, LineBias::as_found, 0, LineEdges::both}),
              Status::ok);
    fake.drive(0, 5, true);
    EXPECT_EQ(input.take_edge().value(), false);
    fake.drive(0, 5, false);
    EXPECT_EQ(input.take_edge().value(), true);
}

TEST_F(Gpio, TellsEveryEdgeWithItsTime) {
    ASSERT_EQ(input.open(chip, "5", "t", {LineLevel::high, LineBias::as_found, 0, LineEdges::both}),
              Status::ok);
    fake.drive(0, 5, true);
    fake.now_ns += 1234567;
    fake.drive(0, 5, false);
    LineEdge edge;
    ASSERT_EQ(input.next_edge(edge), Status::ok);
    EXPECT_EQ(edge.time_us, 5000000);
    EXPECT_TRUE(edge.active);
    EXPECT_EQ(edge.number, 1u);
    EXPECT_EQ(edge.lost, 0u);
    ASSERT_EQ(input.next_edge(edge), Status::ok);
    EXPECT_EQ(edge.time_us, 5001234);
    EXPECT_FALSE(edge.active);
    EXPECT_EQ(edge.number, 2u);
    EXPECT_EQ(input.next_edge(edge), Status::not_found);
    EXPECT_EQ(edge.number, 2u) << "untouched";
}

/// F17: the program stood still, and the kernel kept the newest.
TEST_F(Gpio, CountsTheEdgesThatWereLost) {
    linux_port::InputLineOptions options;
    options.kept_edges = 16;
    ASSERT_EQ(input.open(chip, "5", "t", options), Status::ok);
    for (int i = 0; i < 100; ++i) fake.pulse(0, 5);
    LineEdge edge;
    ASSERT_EQ(input.next_edge(edge), Status::ok);
    EXPECT_EQ(edge.lost, 84u);
    EXPECT_EQ(edge.number, 85u);
    int told = 1;
    for (; input.next_edge(edge) == Status::ok; ++told) EXPECT_EQ(edge.lost, 0u);
    EXPECT_EQ(told, 16);
    EXPECT_EQ(input.lost_edges(), 84u);
    for (int i = 0; i < 20; ++i) fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true);
    EXPECT_EQ(input.lost_edges(), 88u);
    // The count begins again behind the largest number, and another time with the next opening.
    fake.line(0, 5).number = 0xfffffffe;
    fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true);
    const std::uint64_t before = input.lost_edges();
    fake.pulse(0, 5);
    fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true);
    EXPECT_EQ(input.lost_edges(), before);
    ASSERT_EQ(input.open(chip, "5", "t", options), Status::ok);
    EXPECT_EQ(input.lost_edges(), 0u);
}

TEST_F(Gpio, CountsALostActivationAsOne) {
    linux_port::InputLineOptions options;
    options.kept_edges = 1;
    options.edges = LineEdges::both;
    ASSERT_EQ(input.open(chip, "5", "t", options), Status::ok);
    fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true) << "only the end of the pulse was kept";
    EXPECT_EQ(input.lost_edges(), 1u);
}

TEST_F(Gpio, DoesNotStayWithALineThatNeverRests) {
    linux_port::InputLineOptions options;
    options.kept_edges = 5000;
    ASSERT_EQ(input.open(chip, "5", "t", options), Status::ok);
    for (int i = 0; i < 5000; ++i) fake.pulse(0, 5);
    EXPECT_EQ(input.take_edge().value(), true);
    EXPECT_EQ(fake.line(0, 5).events.size(), 5000u - 1024u);
}

TEST_F(Gpio, LosesItsLinesWithTheChip) {
    ASSERT_EQ(output.open(chip, "1", "ok"), Status::ok);
    ASSERT_EQ(input.open(chip, "5", "t"), Status::ok);
    fake.chips[0].gone = true;
    EXPECT_EQ(output.set(true), Status::device_lost);
    EXPECT_FALSE(output.is_open());
    EXPECT_EQ(output.set(true), Status::device_lost);
    EXPECT_EQ(input.take_edge().status(), Status::device_lost);
    EXPECT_FALSE(input.is_open());
    chip.close();
    EXPECT_TRUE(fake.files.empty());
}

TEST_F(Gpio, OutlivesItsChip) {
    ASSERT_EQ(output.open(chip, "1", "ok"), Status::ok);
    chip.close();
    EXPECT_EQ(output.set(true), Status::ok);
    EXPECT_TRUE(fake.line(0, 1).high);
}

TEST_F(Gpio, EndsEverySweepWithAStatus) {
    chip.close();
    std::string claim;
    int good = 0;
    const int runs = sweep(
        system, {EINTR, EIO, ENODEV, EAGAIN, EBUSY, EINVAL, EPERM, ENOTTY, 524},
        [&](auto failing) {
            fake.line(0, 1).high = fake.line(0, 5).high = false;
            linux_port::GpioChip swept(failing);
            linux_port::OutputLine out(failing);
            linux_port::InputLine in(failing);
            if (swept.open("/dev/gpiochip0") != Status::ok) return;
            const auto check = [&](Status status, const auto& line, const char* what) {
                const bool told = line.fault().status == status || !line.is_open();
                if (status != Status::ok && !told) claim = what;
                return status == Status::ok;
            };
            const bool driving = check(out.open(swept, "1", "ok"), out, "open out");
            if (driving != out.is_open()) claim = "open, or not";
            if (driving) {
                const bool set = check(out.set(true), out, "set");
                if (set != fake.line(0, 1).high) claim = "another level";
                good += set;
            }
            if (!check(in.open(swept, "TRIGGER", "trigger"), in, "open in")) return;
            fake.pulse(0, 5);
            const Result<bool> edge = in.take_edge();
            check(edge.status(), in, "take");
            if (edge && !*edge && in.is_open() && fake.line(0, 5).events.empty()) claim = "an edge lost";
            check(in.active().status(), in, "active");
            LineEdge one;
            one.number = 77;
            const Status next = in.next_edge(one);
            if (next != Status::ok && one.number != 77) claim = "touched";
            good += edge.ok();
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at;
            ASSERT_TRUE(fake.files.empty());
            ASSERT_EQ(claim, "") << script.fail_at << " " << script.error << " " << script.for_ever;
        });
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 200);
    EXPECT_GT(good, 100);
}

}  // namespace
}  // namespace fovea::test
