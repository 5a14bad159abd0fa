// SPDX-License-Identifier: MIT
//
// A USB video class camera in software, for a board with the modules vhci-hcd and uvcvideo: the kernel sees a
// camera being plugged in, and drives it as any other. It prints every control that is set. The program's end
// unplugs it.
//
//   usb_camera [OPTIONS]
//     --port N              where it is plugged in, 0 to 7 (0): another camera takes another port
//     --serial TEXT         its serial number (0001)
//     --yuyv|--grey|--mjpeg FILE...   its frames in that mode, one after the other and over again; without
//                           files it shows those of test_frame.hpp
//     --damage N            frame N is marked as damaged; may be said more than once, as --cut
//     --cut N               frame N ends after its first half
//     --unplug-after N      it is unplugged after N frames
//   Frames are counted from 0 and from when it was plugged in, over all streams.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <board/test_frame.hpp>
#include <board/usb_camera_descriptors.hpp>
#include <board/usb_link.hpp>

using namespace fovea::test;

namespace {

using Clock = std::chrono::steady_clock;

struct Options {
    int port = 0;
    std::string serial_number = "0001";
    std::vector<Bytes> files[camera_mode_count];
    std::set<std::uint32_t> damaged;
    std::set<std::uint32_t> cut;
    long unplug_after = -1;  // never
};

std::uint32_t little_endian(const std::uint8_t* bytes, int count) {
    std::uint32_t value = 0;
    while (count-- > 0) value = value << 8 | bytes[count];
    return value;
}

// ---- Requests of the USB video class ------------------------------------------------------

enum VideoRequest : std::uint8_t {
    set_current = 0x01,
    current = 0x81,
    lowest = 0x82,
    highest = 0x83,
    resolution = 0x84,
    length = 0x85,
    information = 0x86,
    standard = 0x87
};
constexpr std::uint32_t readable_and_writable = 3;

Bytes bytes_of(Field field) {
    Bytes list;
    append(list, field);
    return list;
}

struct Control {
    const char* name;
    int unit;
    int selector;
    int bytes;
    int lowest;
    int highest;
    int resolution;
    int standard;
    int value;
};

class Controls {
public:
    /// Answers a request to a unit into `answer`; false: there is no such control or request.
    bool handle(int unit, int selector, int request, const Bytes& data, Bytes& answer) {
        for (Control& control : all_)
            if (control.unit == unit && control.selector == selector)
                return handle(control, request, data, answer);
        return false;
    }

private:
    static bool handle(Control& control, int request, const Bytes& data, Bytes& answer) {
        const auto number = [&](int value) {
            return bytes_of({static_cast<std::uint32_t>(value), control.bytes});
        };
        switch (request) {
            case set_current:
                if (data.size() != static_cast<std::size_t>(control.bytes)) return false;
                set(control, little_endian(data.data(), control.bytes));
                return true;
            case current: answer = number(control.value); return true;
            case lowest: answer = number(control.lowest); return true;
            case highest: answer = number(control.highest); return true;
            case resolution: answer = number(control.resolution); return true;
            case standard: answer = number(control.standard); return true;
            case length: answer = bytes_of(u16(static_cast<std::uint32_t>(control.bytes))); return true;
            case information: answer = bytes_of(u8(readable_and_writable)); return true;
            default: return false;
        }
    }

    static void set(Control& control, std::uint32_t value) {
        control.value = control.bytes == 2 ? static_cast<std::int16_t>(value) : static_cast<int>(value);
        std::printf("usb camera: %s = %d\n", control.name, control.value);
    }

    Control all_[4] = {
        // The resolution of a mode is the set of modes there are: 1 manual, 8 automatic by exposure alone.
        {"exposure_mode", camera_terminal, 0x02, 1, 0, 0, 9, 8, 8},
        {"exposure_100us", camera_terminal, 0x04, 4, 1, 5000, 1, 300, 300},
        {"brightness", processing_unit, 0x02, 2, -64, 64, 1, 0, 0},
        {"gain", processing_unit, 0x04, 2, 0, 255, 1, 10, 10},
    };
};

constexpr int probe = 1;
constexpr int commit = 2;

/// The format and rate that host and camera agree upon: first proposed, then committed.
class Negotiation {
public:
    static constexpr std::uint32_t payload_bytes = 16384;
    static constexpr int block_bytes = 34;

    explicit Negotiation(const std::uint32_t (&frame_bytes)[camera_mode_count]) : frame_bytes_(frame_bytes) {}

    const CameraMode& mode() const { return camera_modes[committed_.mode]; }
    int mode_number() const { return committed_.mode; }
    std::uint32_t rate() const { return committed_.rate; }

    bool handle(int selector, int request, const Bytes& data, Bytes& answer) {
        if (selector != probe && selector != commit) return false;
        switch (request) {
            case set_current:
                if (data.size() < 8) return false;
                proposed_ = nearest(data);
                if (selector == commit) committed_ = proposed_;
                return true;
            case length: answer = bytes_of(u16(block_bytes)); return true;
            case information: answer = bytes_of(u8(readable_and_writable)); return true;
            default: answer = block(selector == commit ? committed_ : proposed_); return true;
        }
    }

private:
    struct Agreement {
        int mode = 0;
        std::uint32_t rate = frame_rates[0];
    };

    static Agreement nearest(const Bytes& data) {
        Agreement agreed;
        if (data[2] >= 1 && data[2] <= camera_mode_count) agreed.mode = data[2] - 1;
        const std::uint32_t interval = little_endian(&data[4], 4);
        if (interval == frame_interval_100ns(frame_rates[1])) agreed.rate = frame_rates[1];
        return agreed;
    }

    Bytes block(const Agreement& agreed) const {
        Bytes list;
        for (const Field& field :
             {u16(1), u8(static_cast<std::uint32_t>(agreed.mode + 1)), u8(1),
              u32(frame_interval_100ns(agreed.rate)), u16(0), u16(0), u16(0), u16(0), u16(0),
              u32(frame_bytes_[agreed.mode]), u32(payload_bytes), u32(clock_hz), u8(0), u8(0), u8(0), u8(0)})
            append(list, field);
        return list;
    }

    const std::uint32_t (&frame_bytes_)[camera_mode_count];
    Agreement proposed_;
    Agreement committed_;
};

// ---- Frames -------------------------------------------------------------------------------

/// Cuts frames into payloads, each with a header, for the transfers that the host has asked for.
class Stream {
public:
    explicit Stream(const Options& options) : options_(options) {}

    std::uint32_t frames() const { return number_; }
    void ask(const UsbLink::Request& transfer) { waiting_.push_back(transfer); }

    /// The host takes a transfer back: was it still waiting?
    bool forget(std::uint32_t transfer) {
        const auto is_it = [=](const UsbLink::Request& asked) { return asked.number == transfer; };
        const auto found = std::find_if(waiting_.begin(), waiting_.end(), is_it);
        if (found == waiting_.end()) return false;
        waiting_.erase(found);
        return true;
    }

    /// What was left of a frame when the host went away is not sent to the next one.
    void start(const Negotiation& agreed) {
        std::printf("usb camera: %s at %u frames/s\n", agreed.mode().name, agreed.rate());
        next_ = Clock::now();
        frame_.clear();
    }

    bool due() const { return !waiting_.empty() && Clock::now() >= next_; }

    int milliseconds_to_wait() const {
        if (waiting_.empty()) return 1000;
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(next_ - Clock::now()).count();
        return left < 0 ? 0 : static_cast<int>(left) + 1;
    }

    /// The next payload, for the transfer that has waited longest.
    bool send(UsbLink& link, const Negotiation& agreed) {
        if (frame_.empty()) begin(agreed);
        const std::size_t header_bytes = 12;
        const bool first = place_ == 0;
        const std::size_t asked = std::min<std::size_t>(waiting_.front().length, Negotiation::payload_bytes);
        const std::size_t taken = std::min(frame_.size() - place_, asked - header_bytes);
        const bool last = place_ + taken == frame_.size();

        Bytes payload(header_bytes);
        payload[0] = header_bytes;
        // Neither frame nor camera has a clock here. The lowest bit changes from frame to frame.
        payload[1] = static_cast<std::uint8_t>(end_of_header | (number_ & 1));
        if (last) payload[1] |= end_of_frame;
        if (first && options_.damaged.count(number_) != 0) payload[1] |= error;
        payload.insert(payload.end(), &frame_[place_], &frame_[place_] + taken);

        const UsbLink::Request transfer = waiting_.front();
        waiting_.pop_front();
        place_ += taken;
        if (last) end(agreed);
        return link.answer(transfer, payload);
    }

private:
    static constexpr std::uint8_t end_of_frame = 0x02;
    static constexpr std::uint8_t error = 0x40;
    static constexpr std::uint8_t end_of_header = 0x80;

    void begin(const Negotiation& agreed) {
        const std::vector<Bytes>& files = options_.files[agreed.mode_number()];
        frame_ = files.empty() ? test_frame(agreed.mode(), number_) : files[number_ % files.size()];
        if (options_.cut.count(number_) != 0) frame_.resize(frame_.size() / 2);
        place_ = 0;
    }

    void end(const Negotiation& agreed) {
        frame_.clear();
        ++number_;
        next_ += std::chrono::microseconds(1000000 / agreed.rate());
        // A busy board makes it slower, not hasty afterwards.
        next_ = std::max(next_, Clock::now() - std::chrono::seconds(1));
    }

    const Options& options_;
    std::deque<UsbLink::Request> waiting_;
    Bytes frame_;  // the one that is being sent; empty between two
    std::size_t place_ = 0;
    std::uint32_t number_ = 0;
    Clock::time_point next_;
};

// ---- The camera ---------------------------------------------------------------------------

class Camera {
public:
    explicit Camera(const Options& options) : options_(options) {
        for (int i = 0; i < camera_mode_count; ++i) {
            const CameraMode& mode = camera_modes[i];
            frame_bytes_[i] =
                static_cast<std::uint32_t>(mode.width * mode.height * std::max(mode.bytes_per_pixel, 1));
            for (const Bytes& file : options.files[i])
                frame_bytes_[i] = std::max(frame_bytes_[i], size_of(file));
        }
    }

    /// Until it is unplugged or the host is gone.
    void run(UsbLink& link) {
        for (;;) {
            while (stream_.due()) {
                if (!stream_.send(link, negotiation_)) return;
                if (static_cast<long>(stream_.frames()) == options_.unplug_after) return;
            }
            if (!link.wait(stream_.milliseconds_to_wait())) continue;
            const auto request = link.next();
            if (!request || !handle(link, *request)) return;
        }
    }

    std::uint32_t frames() const { return stream_.frames(); }

private:
    bool handle(UsbLink& link, const UsbLink::Request& request) {
        if (request.forget) return link.forget(request, stream_.forget(request.forgotten));
        if (request.endpoint != 0) {
            stream_.ask(request);
            return true;
        }
        Bytes answer;
        if (!control(request, answer)) return link.stall(request);
        if (answer.size() > request.length) answer.resize(request.length);
        return link.answer(request, answer);
    }

    /// A control transfer, chapter 9 of USB 2.0 or of the video class.
    bool control(const UsbLink::Request& request, Bytes& answer) {
        const int kind = request.setup[0] & 0x60;
        const int what = request.setup[1];
        const int low_value = request.setup[2];
        const int high_value = request.setup[3];
        const int interface = request.setup[4];
        const int unit = request.setup[5];
        if (kind == 0) return standard_request(what, high_value, low_value, answer);
        if (interface == 0) return controls_.handle(unit, high_value, what, request.data, answer);
        const bool known = negotiation_.handle(high_value, what, request.data, answer);
        // With this a driver begins every stream.
        if (known && high_value == commit && what == set_current) stream_.start(negotiation_);
        return known;
    }

    bool standard_request(int what, int type, int index, Bytes& answer) const {
        enum { status = 0, clear_feature = 1, set_feature = 3, descriptor = 6 };
        enum { configuration = 8, set_configuration = 9, interface = 10, set_interface = 11 };
        switch (what) {
            case status: answer = bytes_of(u16(1)); return true;  // it has a supply of its own
            case configuration: answer = bytes_of(u8(1)); return true;
            case interface: answer = bytes_of(u8(0)); return true;
            case clear_feature:
            case set_feature:
            case set_configuration:
            case set_interface: return true;
            case descriptor: return descriptor_of(type, index, answer);
            default: return false;
        }
    }

    bool descriptor_of(int type, int index, Bytes& answer) const {
        const std::string strings[] = {"fovea", "test camera", options_.serial_number};
        if (type == device_type) answer = device_descriptor();
        if (type == configuration_type) answer = configuration_descriptor(frame_bytes_);
        if (type == string_type && index == 0) answer = language_descriptor();
        if (type == string_type && index >= 1 && index <= 3) answer = string_descriptor(strings[index - 1]);
        return !answer.empty();
    }

    const Options& options_;
    std::uint32_t frame_bytes_[camera_mode_count];  // the most of each mode
    Controls controls_;
    Negotiation negotiation_{frame_bytes_};
    Stream stream_{options_};
};

// ---- The command line ---------------------------------------------------------------------

/// A frame of a mode, or a complaint and the end.
Bytes read_frame(int mode, const char* path) {
    std::ifstream file(path, std::ios::binary);
    Bytes frame{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    const bool compressed = camera_modes[mode].bytes_per_pixel == 0;
    const std::size_t wanted = test_frame_bytes(camera_modes[mode], 0);
    if (frame.empty() || (!compressed && frame.size() != wanted)) {
        std::fprintf(stderr, "usb_camera: %s is no frame of mode %s\n", path, camera_modes[mode].name);
        std::exit(2);
    }
    return frame;
}

[[noreturn]] void refuse(const char* word) {
    std::fprintf(stderr, "usb_camera: not understood: %s\n", word);
    std::exit(2);
}

/// An option and its value; false: there is no such option.
bool take_option(Options& options, const std::string& word, const char* value) {
    const long number = std::atol(value);
    if (word == "--port")
        options.port = static_cast<int>(number);
    else if (word == "--serial")
        options.serial_number = value;
    else if (word == "--damage")
        options.damaged.insert(static_cast<std::uint32_t>(number));
    else if (word == "--cut")
        options.cut.insert(static_cast<std::uint32_t>(number));
    else if (word == "--unplug-after")
        options.unplug_after = number;
    else
        return false;
    return true;
}

Options parse(const std::vector<const char*>& words) {
    Options options;
    int mode = -1;  // that the files belong to
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool file = std::strncmp(words[i], "--", 2) != 0;
        const CameraMode* named = file ? nullptr : camera_mode(words[i] + 2);
        if (file && mode < 0) refuse(words[i]);
        if (file) {
            options.files[mode].push_back(read_frame(mode, words[i]));
        } else if (named != nullptr) {
            mode = static_cast<int>(named - camera_modes);
        } else {
            if (i + 1 == words.size() || !take_option(options, words[i], words[i + 1])) refuse(words[i]);
            ++i;
        }
    }
    return options;
}

}  // namespace

int main(int count, char** words) {
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    const Options options = parse({words + 1, words + count});
    Camera camera(options);
    {
        UsbLink link;
        if (!link.plug_in(options.port)) {
            std::fprintf(stderr,
                         "usb_camera: cannot plug in at port %d: is vhci-hcd loaded, and the port free?\n",
                         options.port);
            return 1;
        }
        camera.run(link);
    }
    std::printf("usb camera: unplugged after %u frames\n", camera.frames());
    return 0;
}
