// SPDX-License-Identifier: MIT
//
// Settings: what the daemon is told by its configuration file. One table of keys makes the parser, the help,
// the sample file and the manual page.
#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include <fovea/base/list.hpp>
#include <fovea/hal/pixel_format.hpp>
#include <fovea/image/workers.hpp>
#include <fovea/linux/replay_files.hpp>
#include <fovea/linux/text.hpp>

#include <daemon/image_quality.hpp>
#include <daemon/verdict_lines.hpp>

namespace fovea::apps {

using linux_port::Text;

enum class TriggerSource : std::uint8_t { free, line, command };

/// A control of the camera by name.
struct ControlChoice {
    Text<63> name;
    std::int64_t value = 0;
};

struct Settings {
    static constexpr int most_controls = 32;

    struct Camera {
        Text<191> device;
        Text<191> replay;
        linux_port::ReplayEnd replay_end = linux_port::ReplayEnd::repeat;
        std::int64_t width = 0;
        std::int64_t height = 0;
        hal::PixelFormat format = hal::PixelFormat::none;
        std::int64_t rate_per_s = 10;
        std::int64_t buffers = 4;
        bool every_frame = false;
    } camera;
    List<ControlChoice, most_controls> controls;
    struct Trigger {
        TriggerSource source = TriggerSource::free;
        Text<63> line;
        std::int64_t debounce_us = 0;
        std::int64_t timeout_ms = 1000;
    } trigger;
    struct Lines {
        Text<63> chip;
        Text<63> ready;
        Text<63> busy;
        Text<63> valid;
        Text<63> ok;
        Text<63> not_ok;
        Text<63> alarm;
        bool active_low = false;
        LineMode mode = LineMode::hold;
        std::int64_t pulse_ms = 50;
        bool error_is_not_ok = false;
    } lines;
    struct Serial {
        Text<191> device;
        std::int64_t baud = 115200;
        bool rs485 = false;
        bool commands = true;
        bool silent = false;
        Text<256> results;
    } serial;
    struct Jobs {
        Text<191> folder;
        Text<63> start;
    } jobs;
    struct Teach {
        Text<191> folder;
    } teach;
    struct Results {
        bool json = true;
    } results;
    struct Failures {
        Text<191> folder;
        std::int64_t megabytes = 100;
        std::int64_t pictures = 1000;
    } failures;
    struct Processor {
        std::int64_t threads = 0;
    } processor;
    struct Quality {
        std::int64_t most_dark = 990;
        std::int64_t most_saturated = 950;
        std::int64_t least_contrast = 10;
        std::int64_t least_sharpness = 150;
    } quality;
};

/// The limits of pictures that can be judged.
inline ImageQualityLimits quality_limits(const Settings::Quality& settings) {
    ImageQualityLimits limits;
    limits.most_dark = static_cast<int>(settings.most_dark);
    limits.most_saturated = static_cast<int>(settings.most_saturated);
    limits.least_contrast = static_cast<int>(settings.least_contrast);
    limits.least_sharpness = static_cast<int>(settings.least_sharpness);
    return limits;
}

/// How long an answer stands on its lines.
inline LineTiming line_timing(const Settings::Lines& settings) {
    return {settings.mode, settings.pulse_ms * 1000, settings.error_is_not_ok};
}

enum class SettingType : std::uint8_t { text, integer, boolean, choice };

/// A value on its way from text to settings: a choice as its number in the list.
struct SettingValue {
    std::int64_t number = 0;
    Span<const char> text;
};

/// What it takes to follow a key that was changed while the daemon runs.
enum class SettingChange : std::uint8_t {
    between_frames,
    reopens,  ///< all devices are opened anew
};

/// A key of the file.
struct SettingKey {
    /// Where its value is kept.
    struct Place {
        void (*load)(Settings& settings, const SettingValue& value);
        bool (*same)(const Settings& a, const Settings& b);
    };

    const char* table;
    const char* name;
    SettingType type;
    const char* otherwise;  ///< what stands where the key is absent, as in a file
    const char* text;       ///< one line of help
    SettingChange change;
    Place place;
    std::int64_t low = 0;  ///< of an integer; of a text its most letters in high
    std::int64_t high = 0;
    const char* choices = "";
};

/// All keys, table by table. A table whose name stands in [[ ]] may come more than once.
Span<const SettingKey> setting_keys();

/// Whether devices that are open by the one are as the other wants them.
inline bool same_devices(const Settings& a, const Settings& b) {
    for (const SettingKey& key : setting_keys())
        if (key.change == SettingChange::reopens && !key.place.same(a, b)) return false;
    return true;
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <int Capacity>
void load_text(Text<Capacity>& into, const SettingValue& value) {
    into.clear();
    into.add(value.text);
}
template <auto Part, auto Member>
bool same_at(const Settings& a, const Settings& b) {
    return (a.*Part).*Member == (b.*Part).*Member;
}
template <auto Part, auto Member>
inline constexpr SettingKey::Place text_at = {
    [](Settings& settings, const SettingValue& value) { load_text((settings.*Part).*Member, value); },
    same_at<Part, Member>};
template <auto Part, auto Member>
inline constexpr SettingKey::Place number_at = {
    [](Settings& settings, const SettingValue& value) {
        auto& member = (settings.*Part).*Member;
        member = static_cast<std::remove_reference_t<decltype(member)>>(value.number);
    },
    same_at<Part, Member>};

/// Of the control that was begun last; the same is a list of the same controls.
template <auto Member>
bool same_controls(const Settings& a, const Settings& b) {
    if (a.controls.size() != b.controls.size()) return false;
    for (int k = 0; k < a.controls.size(); ++k)
        if (!(a.controls[k].*Member == b.controls[k].*Member)) return false;
    return true;
}
inline constexpr SettingKey::Place name_of_control = {
    [](Settings& s, const SettingValue& v) { load_text(s.controls[s.controls.size() - 1].name, v); },
    same_controls<&ControlChoice::name>};
inline constexpr SettingKey::Place value_of_control = {
    [](Settings& s, const SettingValue& v) { s.controls[s.controls.size() - 1].value = v.number; },
    same_controls<&ControlChoice::value>};
inline constexpr SettingKey::Place nowhere = {[](Settings&, const SettingValue&) {},
                                              [](const Settings&, const Settings&) { return true; }};

}  // namespace detail

inline Span<const SettingKey> setting_keys() {
    using namespace detail;
    using S = Settings;
    constexpr SettingType text = SettingType::text;
    constexpr SettingType integer = SettingType::integer;
    constexpr SettingType boolean = SettingType::boolean;
    constexpr SettingType choice = SettingType::choice;
    constexpr SettingChange live = SettingChange::between_frames;
    constexpr SettingChange anew = SettingChange::reopens;
    static constexpr SettingKey keys[] = {
        {"", "format", integer, "1", "version of this file format", live, nowhere, 1, 1},

        {"camera", "device", text, "\"auto\"",
         "the camera: \"auto\", \"/dev/video0\", \"usb:046d:0825\" with \":serial\" behind it, or "
         "\"path:...\"",
         anew, text_at<&S::camera, &S::Camera::device>, 0, 191},
        {"camera", "replay", text, "\"\"", "a picture, a folder or a FIFO to judge in place of a camera",
         anew, text_at<&S::camera, &S::Camera::replay>, 0, 191},
        {"camera", "replay_end", choice, "\"repeat\"",
         "of a replay: what comes behind the last picture; \"watch\" waits for new ones in the folder", anew,
         number_at<&S::camera, &S::Camera::replay_end>, 0, 0, "stop|repeat|watch"},
        {"camera", "width", integer, "0",
         "width of the frames in pixels; 0 for the largest that is fast enough", anew,
         number_at<&S::camera, &S::Camera::width>, 0, 32767},
        {"camera", "height", integer, "0", "height of the frames in pixels; 0 as for the width", anew,
         number_at<&S::camera, &S::Camera::height>, 0, 32767},
        {"camera", "pixel_format", choice, "\"any\"", "how the camera packs its pixels", anew,
         number_at<&S::camera, &S::Camera::format>, 0, 0,
         "any|gray8|gray10|gray12|gray16|yuyv|uyvy|nv12|rgb24|bgr24|rgb565|bayer-rggb|bayer-grbg|bayer-gbrg|"
         "bayer-bggr|mjpeg"},
        {"camera", "rate_per_s", integer, "10",
         "frames a second: the camera is set to so many, in a mode that can do them", anew,
         number_at<&S::camera, &S::Camera::rate_per_s>, 1, 10000},
        {"camera", "buffers", integer, "4", "frames that the driver holds", anew,
         number_at<&S::camera, &S::Camera::buffers>, 2, 16},
        {"camera", "every_frame", boolean, "false", "judge every frame in its order, instead of the newest",
         live, number_at<&S::camera, &S::Camera::every_frame>},

        {"[[control]]", "name", text, "",
         "a control of the camera, as v4l2-ctl lists it: \"exposure_time_absolute\"", anew, name_of_control,
         1, 63},
        {"[[control]]", "value", integer, "", "what it is set to; automatic modes are set first", anew,
         value_of_control, -99999999, 99999999},

        {"trigger", "source", choice, "\"free\"",
         "what starts a judgement: nothing but the camera, an edge on a line, or the command TRG", anew,
         number_at<&S::trigger, &S::Trigger::source>, 0, 0, "free|line|command"},
        {"trigger", "line", text, "\"\"", "of \"line\": its name or its number on the chip of [lines]", anew,
         text_at<&S::trigger, &S::Trigger::line>, 0, 63},
        {"trigger", "debounce_us", integer, "0", "of \"line\": how long it must stand before it counts", anew,
         number_at<&S::trigger, &S::Trigger::debounce_us>, 0, 1000000},
        {"trigger", "timeout_ms", integer, "1000",
         "how long a frame may take to come before the answer is ERROR", live,
         number_at<&S::trigger, &S::Trigger::timeout_ms>, 10, 60000},

        {"lines", "chip", text, "\"\"", "the GPIO chip: \"/dev/gpiochip0\" or its label; \"\" for no lines",
         anew, text_at<&S::lines, &S::Lines::chip>, 0, 63},
        {"lines", "ready", text, "\"\"", "line that says a trigger would be answered: its name or number",
         anew, text_at<&S::lines, &S::Lines::ready>, 0, 63},
        {"lines", "busy", text, "\"\"", "line that says one is being answered", anew,
         text_at<&S::lines, &S::Lines::busy>, 0, 63},
        {"lines", "valid", text, "\"\"", "line that says ok and ng may be read", anew,
         text_at<&S::lines, &S::Lines::valid>, 0, 63},
        {"lines", "ok", text, "\"\"", "line of the verdict OK", anew, text_at<&S::lines, &S::Lines::ok>, 0,
         63},
        {"lines", "ng", text, "\"\"", "line of the verdict not OK", anew,
         text_at<&S::lines, &S::Lines::not_ok>, 0, 63},
        {"lines", "alarm", text, "\"\"", "line that says a person must look after something", anew,
         text_at<&S::lines, &S::Lines::alarm>, 0, 63},
        {"lines", "active_low", boolean, "false", "active is the low level, for all of them", anew,
         number_at<&S::lines, &S::Lines::active_low>},
        {"lines", "mode", choice, "\"hold\"", "an answer stands until the next trigger, or for a pulse", live,
         number_at<&S::lines, &S::Lines::mode>, 0, 0, "hold|pulse"},
        {"lines", "pulse_ms", integer, "50", "of \"pulse\": how long", live,
         number_at<&S::lines, &S::Lines::pulse_ms>, 1, 10000},
        {"lines", "error_is_ng", boolean, "false", "show what could not be judged as not OK", live,
         number_at<&S::lines, &S::Lines::error_is_not_ok>},

        {"serial", "device", text, "\"\"",
         "the serial port: \"/dev/ttyUSB0\", \"usb:0403:6001\" with \":serial\" behind it, or "
         "\"path:...\"; \"\" for none",
         anew, text_at<&S::serial, &S::Serial::device>, 0, 191},
        {"serial", "baud", integer, "115200", "bits a second", anew, number_at<&S::serial, &S::Serial::baud>,
         50, 4000000},
        {"serial", "rs485", boolean, "false", "let the driver switch the direction of an RS-485 line", anew,
         number_at<&S::serial, &S::Serial::rs485>},
        {"serial", "commands", boolean, "true", "obey commands that arrive", live,
         number_at<&S::serial, &S::Serial::commands>},
        {"serial", "silent", boolean, "false",
         "reply only to commands that ask, and with errors: so that an OK is a verdict", live,
         number_at<&S::serial, &S::Serial::silent>},
        {"serial", "results", text, "\"plain\"",
         "what a result is sent as: plain, pass-fail, stx-etx, csv, json, a template such as "
         "\"{seq:6};{verdict}\\\\r\\\\n\", or \"\" for nothing",
         live, text_at<&S::serial, &S::Serial::results>, 0, 256},

        {"jobs", "folder", text, "\"jobs\"",
         "folder of the recipes, each NAME.toml; beside this file if not absolute", live,
         text_at<&S::jobs, &S::Jobs::folder>, 1, 191},
        {"jobs", "start", text, "\"\"", "the job to begin with; \"\" for the first by name", live,
         text_at<&S::jobs, &S::Jobs::start>, 0, 63},

        {"teach", "folder", text, "\"\"",
         "folder for the samples that the command TEACH keeps, as /var/lib/fovead/samples; \"\" to keep none",
         live, text_at<&S::teach, &S::Teach::folder>, 0, 191},

        {"results", "json", boolean, "true", "print every result as a line of JSON", live,
         number_at<&S::results, &S::Results::json>},

        {"failures", "folder", text, "\"\"",
         "folder for pictures of what was not OK, as /var/lib/fovead/failures; \"\" to keep none", anew,
         text_at<&S::failures, &S::Failures::folder>, 0, 191},
        {"failures", "megabytes", integer, "100", "how much they may take up, in MB", anew,
         number_at<&S::failures, &S::Failures::megabytes>, 1, 1000000},
        {"failures", "pictures", integer, "1000", "how many are kept at most", anew,
         number_at<&S::failures, &S::Failures::pictures>, 1, 1000000},

        {"processor", "threads", integer, "0",
         "how many threads work on a picture at once; 0 for one on each processor, at most 4", anew,
         number_at<&S::processor, &S::Processor::threads>, 0, most_workers},

        {"quality", "most_dark", integer, "990",
         "no verdict if more thousandths of a picture are darker than level 32; 1000 for never", live,
         number_at<&S::quality, &S::Quality::most_dark>, 1, 1000},
        {"quality", "most_saturated", integer, "950",
         "no verdict if more thousandths of it are brighter than level 249; 1000 for never", live,
         number_at<&S::quality, &S::Quality::most_saturated>, 1, 1000},
        {"quality", "least_contrast", integer, "10",
         "no verdict if its brightest and darkest levels differ by less; 0 for never", live,
         number_at<&S::quality, &S::Quality::least_contrast>, 0, 255},
        {"quality", "least_sharpness", integer, "150",
         "no verdict if its sharpest edges are softer, in thousandths; 0 for never. Out of focus by 2 px is "
         "165",
         live, number_at<&S::quality, &S::Quality::least_sharpness>, 0, 1000},
    };
    return {keys, static_cast<std::ptrdiff_t>(sizeof keys / sizeof keys[0])};
}

}  // namespace fovea::apps
