// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <string>

#include <daemon/settings_reader.hpp>

namespace fovea::apps {
namespace {

std::string problem_of(const std::string& text) {
    Settings settings;
    const SettingsProblem found = read_settings(text, settings);
    if (found.problem.empty()) return "";
    return std::to_string(found.place.line) + ":" + std::to_string(found.place.column) + ": " + found.problem;
}

TEST(Settings, AreTheirDefaultsWhereNothingIsSaid) {
    Settings settings;
    ASSERT_EQ(read_settings("format = 1\n", settings).problem, "");
    EXPECT_STREQ(settings.camera.device.c_str(), "auto");
    EXPECT_EQ(settings.camera.rate_per_s, 10);
    EXPECT_EQ(settings.trigger.source, TriggerSource::free);
    EXPECT_STREQ(settings.serial.results.c_str(), "plain");
    EXPECT_STREQ(settings.jobs.folder.c_str(), "jobs");
    EXPECT_TRUE(settings.results.json);
}

TEST(Settings, TakeWhatIsSaid) {
    Settings settings;
    ASSERT_EQ(read_settings(
                  "format = 1\n[camera]\ndevice = \"usb:046d:0825\"\nwidth = 640\npixel_format = \"mjpeg\"\n"
                  "every_frame = true\n[[control]]\nname = \"gain\"\nvalue = -3\n[[control]]\nname = \"x\"\n"
                  "value = 1\n[trigger]\nsource = \"line\"\nline = \"4\"\n[lines]\nchip = \"a\"\nmode = "
                  "\"pulse\"\nng = \"reject\"\n"
                  "[serial]\nresults = \"{seq:6};{verdict}\\\\r\\\\n\"\n",
                  settings)
                  .problem,
              "");
    EXPECT_STREQ(settings.camera.device.c_str(), "usb:046d:0825");
    EXPECT_EQ(settings.camera.width, 640);
    EXPECT_EQ(settings.camera.format, hal::PixelFormat::mjpeg);
    EXPECT_TRUE(settings.camera.every_frame);
    ASSERT_EQ(settings.controls.size(), 2);
    EXPECT_EQ(settings.controls[0].value, -3);
    EXPECT_STREQ(settings.controls[1].name.c_str(), "x");
    EXPECT_EQ(settings.trigger.source, TriggerSource::line);
    EXPECT_EQ(settings.lines.mode, LineMode::pulse);
    EXPECT_STREQ(settings.lines.not_ok.c_str(), "reject");
    EXPECT_STREQ(settings.serial.results.c_str(), "{seq:6};{verdict}\\r\\n");
}

TEST(Settings, SayWhatIsWrongAndWhere) {
    EXPECT_EQ(problem_of("[camera]\n"), "1:1: the key format = 1 is missing");
    EXPECT_EQ(problem_of("format = 2\n"), "1:10: format is from 1 to 1");
    EXPECT_EQ(problem_of("format = 1\n[camra]\n"), "2:2: unknown table camra; did you mean camera?");
    EXPECT_EQ(problem_of("format = 1\n[camera]\nwidht = 3\n"),
              "3:1: unknown key widht in camera; did you mean width?");
    EXPECT_EQ(problem_of("format = 1\n[camera]\nwidth = \"3\"\n"), "3:9: width is a whole number");
    EXPECT_EQ(problem_of("format = 1\n[camera]\nwidth = 99999\n"), "3:9: width is from 0 to 32767");
    EXPECT_EQ(problem_of("format = 1\n[camera]\nwidth = 1\nwidth = 2\n"), "4:1: width stands twice");
    EXPECT_EQ(problem_of("format = 1\n[camera]\n[camera]\n"), "3:2: [camera] stands twice");
    EXPECT_EQ(problem_of("format = 1\n[camera]\nevery_frame = 1\n"), "3:15: every_frame is true or false");
    EXPECT_EQ(problem_of("format = 1\n[lines]\nmode = \"puls\"\n"),
              "3:8: mode is one of hold or pulse; did you mean pulse?");
    EXPECT_EQ(problem_of("format = 1\n[control]\n"),
              "2:2: [[control]] has two brackets, since it may come again");
    EXPECT_EQ(problem_of("format = 1\n[[camera]]\n"), "2:3: [camera] has one bracket, since it comes once");
    EXPECT_EQ(problem_of("format = 1\n[[control]]\nname = \"gain\"\n"),
              "4:1: a [[control]] without its value");
    EXPECT_EQ(problem_of("format = 1\n[serial]\nresults = \"{verdikt}\"\n"),
              "3:11: results: no such field, at letter 2; man fovead.conf has all");
    EXPECT_EQ(problem_of("format = 1\n[serial]\nresults = \"{verdict}\\r\\n\"\n"),
              "3:11: results has a control character, or is no UTF-8; a line ends with \\\\r\\\\n here");
    EXPECT_EQ(problem_of("format = 1\n[jobs]\nfolder = \"\"\n"), "3:10: folder is empty");
    EXPECT_EQ(problem_of("format = 1\n[jobs]\nstart = \"" + std::string(64, 'a') + "\"\n"),
              "3:9: start is longer than 63 bytes");
    EXPECT_NE(problem_of("format = 1\n[jobs\n"), "");
    std::string many = "format = 1\n";
    for (int k = 0; k < 33; ++k) many += "[[control]]\nname = \"a\"\nvalue = 1\n";
    EXPECT_EQ(problem_of(many), "98:3: more than 32 of [[control]]");
}

TEST(Settings, SayWhichLineIsMissingOrThereTwice) {
    const std::string by_line = "format = 1\n[trigger]\nsource = \"line\"\n";
    const std::string chip = "[lines]\nchip = \"a\"\n";
    EXPECT_EQ(problem_of(by_line + "line = \"4\"\n"), "3:10: source = \"line\" wants a chip in [lines]");
    EXPECT_EQ(problem_of(by_line + chip), "3:10: source = \"line\" wants a line = beside it");
    EXPECT_EQ(problem_of(by_line + "line = \"4\"\n" + chip + "ok = \"5\"\n"), "");
    EXPECT_EQ(problem_of(by_line + "line = \"4\"\n" + chip + "ok = \"4\"\n"),
              "4:8: the trigger has the line of ok");
    EXPECT_EQ(problem_of("format = 1\n" + chip + "ng = \"5\"\nok = \"5\"\n"), "4:6: ng has the line of ok");
    // Of what is not used nothing is taken.
    EXPECT_EQ(problem_of("format = 1\n[lines]\nng = \"5\"\nok = \"5\"\n"), "");
    EXPECT_EQ(problem_of("format = 1\n[trigger]\nline = \"5\"\n" + chip + "ok = \"5\"\n"), "");
}

TEST(Settings, StayAsTheyWereAfterAProblem) {
    Settings settings;
    settings.camera.width = 77;
    EXPECT_NE(read_settings("format = 1\n[camera]\nwidth = 5\nheight = x\n", settings).problem, "");
    EXPECT_EQ(settings.camera.width, 77);
}

TEST(Settings, TellWhichOfThemOpenTheDevicesAnew) {
    const std::string base = "format = 1\n";
    const auto opens_anew = [&](const std::string& text) {
        Settings before;
        Settings after;
        EXPECT_EQ(read_settings(base, before).problem, "");
        EXPECT_EQ(read_settings(base + text, after).problem, "") << text;
        EXPECT_TRUE(same_devices(after, after));
        return !same_devices(before, after);
    };
    // Each key in turn, with a value that is not its default.
    int changed = 0;
    for (const SettingKey& key : setting_keys()) {
        if (key.table[0] == '\0') continue;
        std::string value = "\"x\"";
        if (key.type == SettingType::integer) value = std::to_string(key.low + 3);
        if (key.type == SettingType::boolean) value = std::string(key.otherwise) == "true" ? "false" : "true";
        if (key.type == SettingType::choice)
            for (const std::string& choice : split(key.choices, '|'))
                if ("\"" + choice + "\"" != key.otherwise) value = "\"" + choice + "\"";
        std::string table = "[" + std::string(key.table) + "]\n";
        std::string rest;
        if (key.table[0] == '[') {
            table = std::string(key.table) + "\n";
            rest = std::string(key.name) == "name" ? "value = 1\n" : "name = \"gain\"\n";
        }
        const std::string text = table + key.name + " = " + value + "\n" + rest;
        EXPECT_EQ(opens_anew(text), key.change == SettingChange::reopens) << text;
        ++changed;
    }
    EXPECT_GT(changed, 40);
    EXPECT_TRUE(opens_anew("[lines]\nok = \"7\"\n"));
    EXPECT_FALSE(opens_anew("[lines]\nmode = \"pulse\"\n[quality]\nleast_contrast = 0\n"));
    const std::string gain = "[[control]]\nname = \"gain\"\nvalue = ";
    Settings one;
    Settings other;
    EXPECT_EQ(read_settings(base + gain + "1\n", one).problem, "");
    EXPECT_EQ(read_settings(base + gain + "2\n", other).problem, "");
    EXPECT_FALSE(same_devices(one, other));
}

TEST(Settings, HaveASampleThatIsTheDefaults) {
    const std::string sample = sample_settings();
    EXPECT_EQ(problem_of(sample), "");
    // With the part that is commented out, too.
    std::string whole = sample;
    for (std::size_t at; (at = whole.find("\n#[[control]]")) != std::string::npos;) whole.erase(at + 1, 1);
    for (const char* key : {"\n#name = ", "\n#value = "})
        for (std::size_t at; (at = whole.find(key)) != std::string::npos;) whole.erase(at + 1, 1);
    EXPECT_EQ(problem_of(whole), "");
    for (const SettingKey& key : setting_keys())
        EXPECT_NE(sample.find(std::string(key.name) + " = "), std::string::npos);
    EXPECT_NE(settings_manual().find(".B pulse_ms"), std::string::npos);
}

}  // namespace
}  // namespace fovea::apps
