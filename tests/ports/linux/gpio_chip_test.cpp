// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fovea/linux/gpio_chip.hpp>
#include <support/failing_system.hpp>
#include <support/fake_gpio_chip.hpp>

namespace fovea::test {
namespace {

struct GpioChip : testing::Test {
    GpioChip() {
        fake.chips = {{"gpiochip0", "9030000.pl061", std::vector<FakeGpio::Line>(8)},
                      {"gpiochip1", "pinctrl-bcm2711", std::vector<FakeGpio::Line>(58)},
                      {"gpiochip2", "gpio-mockup", std::vector<FakeGpio::Line>(4)},
                      {"gpiochip3", "gpio-mockup-B", std::vector<FakeGpio::Line>(4)},
                      {"gpiochip4", "gpio-mockup-A", std::vector<FakeGpio::Line>(4)}};
        fake.line(1, 17).name = "GPIO17";
        fake.line(1, 20).name = fake.line(1, 21).name = "LED";
        fake.line(1, 22).name = "5";
    }

    FakeGpio fake;
    linux_port::GpioChip<FakeGpioSystem> chip{FakeGpioSystem{&fake}};
};

TEST_F(GpioChip, IsFoundByItsPathItsLabelOrItsName) {
    ASSERT_EQ(chip.open("/dev/gpiochip1"), Status::ok);
    EXPECT_STREQ(chip.label(), "pinctrl-bcm2711");
    EXPECT_EQ(chip.lines(), 58u);
    ASSERT_EQ(chip.open("9030000.pl061"), Status::ok);
    EXPECT_STREQ(chip.name(), "gpiochip0");
    ASSERT_EQ(chip.open("pl061"), Status::ok);
    EXPECT_STREQ(chip.name(), "gpiochip0");
    ASSERT_EQ(chip.open("gpiochip3"), Status::ok);
    EXPECT_STREQ(chip.label(), "gpio-mockup-B");
    // A whole label before a part of others, in whatever order they are found.
    ASSERT_EQ(chip.open("gpio-mockup"), Status::ok);
    EXPECT_STREQ(chip.name(), "gpiochip2");
    std::swap(fake.chips[2].label, fake.chips[4].label);
    ASSERT_EQ(chip.open("gpio-mockup"), Status::ok);
    EXPECT_STREQ(chip.name(), "gpiochip4");
    EXPECT_EQ(fake.files.size(), 1u);
}

TEST_F(GpioChip, IsNotGuessed) {
    EXPECT_EQ(chip.open("mockup-"), Status::undecided);
    EXPECT_TRUE(fake.files.empty());
    EXPECT_EQ(chip.open("nothing"), Status::not_found);
    EXPECT_TRUE(fake.files.empty());
    EXPECT_EQ(chip.open(""), Status::bad_argument);
    EXPECT_EQ(chip.open("/dev/gpiochip9"), Status::not_found);
    EXPECT_EQ(chip.fault().error, ENOENT);
    EXPECT_TRUE(fake.files.empty());
    EXPECT_EQ(chip.line("0").status(), Status::device_lost) << "it is not open";
}

TEST_F(GpioChip, PassesOverAChipThatIsGone) {
    fake.chips[0].gone = true;
    ASSERT_EQ(chip.open("bcm2711"), Status::ok);
    EXPECT_EQ(chip.open("pl061"), Status::not_found);
    EXPECT_EQ(chip.open("/dev/gpiochip0"), Status::device_lost);
}

TEST_F(GpioChip, KnowsItsLinesByNumberOrName) {
    ASSERT_EQ(chip.open("bcm2711"), Status::ok);
    EXPECT_EQ(chip.line("GPIO17").value(), 17u);
    EXPECT_EQ(chip.line("0").value(), 0u);
    EXPECT_EQ(chip.line("57").value(), 57u);
    EXPECT_EQ(chip.line("5").value(), 5u) << "a number before a name";
    for (const char* none : {"58", "4294967296", "99999999999999999999", "", "gpio17", "-1", "GPIO1"})
        EXPECT_EQ(chip.line(none).status(), Status::not_found) << none;
    EXPECT_EQ(chip.line("LED").status(), Status::undecided);
    fake.chips[1].gone = true;
    EXPECT_EQ(chip.line("GPIO17").status(), Status::device_lost);
}

TEST(GpioChipOfTheHost, IsNotWhatIsNoChip) {
    linux_port::GpioChip chip(linux_port::Kernel{});
    EXPECT_EQ(chip.open("/dev/null"), Status::unsupported);
    EXPECT_STREQ(linux_port::advice(chip.fault()), "this is not a GPIO chip: they are /dev/gpiochip*");
    EXPECT_EQ(chip.open("a label that no chip has"), Status::not_found);
}

TEST_F(GpioChip, EndsEverySweepWithAStatus) {
    std::string claim;
    int found = 0;
    const int runs = sweep(
        FakeGpioSystem{&fake}, {EINTR, EIO, ENODEV, EACCES, EMFILE, EINVAL, ENOTTY},
        [&](auto system) {
            linux_port::GpioChip swept(system);
            const Status status = swept.open("bcm2711");
            if (status != Status::ok && swept.fault().status != status) claim = "no fault of open";
            if (status != Status::ok) return;
            if (std::string(swept.name()) != "gpiochip1") claim = "another chip";
            const Result<std::uint32_t> line = swept.line("GPIO17");
            if (line ? *line != 17 : swept.fault().status != line.status()) claim = "another line";
            found += line.ok();
        },
        [&](const SystemScript& script) {
            ASSERT_TRUE(script.all_given_back()) << script.fail_at;
            ASSERT_TRUE(fake.files.empty());
            ASSERT_EQ(claim, "") << script.fail_at << " " << script.error << " " << script.for_ever;
        });
    RecordProperty("runs", runs);
    EXPECT_GE(runs, 500);
    EXPECT_GT(found, 50);
}

}  // namespace
}  // namespace fovea::test
