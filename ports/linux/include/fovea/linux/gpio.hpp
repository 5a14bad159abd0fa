// SPDX-License-Identifier: MIT
//
// Lines of a GPIO chip as pins: what a program drives, and what it watches.
#pragma once

#include <linux/gpio.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/digital_pin.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/gpio_chip.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/text.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// The level at which a line is active.
enum class LineLevel : std::uint8_t { high, low };

/// How a line is driven. With the two others one level is driven, and the other left to a resistor.
enum class LineDrive : std::uint8_t { push_pull, open_drain, open_source };

/// The resistor of the chip at a line, where it has one; some chips take the word and do nothing.
enum class LineBias : std::uint8_t { as_found, none, pull_up, pull_down };

/// Which changes of a line are told.
enum class LineEdges : std::uint8_t { activation, both };

struct OutputLineOptions {
    LineLevel active = LineLevel::high;
    LineDrive drive = LineDrive::push_pull;
};

struct InputLineOptions {
    LineLevel active = LineLevel::high;
    LineBias bias = LineBias::as_found;
    /// A level counts when it has stood so long: more is safer from bounces, and later. 0 for at once.
    std::uint32_t debounce_us = 0;
    LineEdges edges = LineEdges::activation;
    /// How many edges the kernel keeps until they are taken; beyond that it loses the oldest.
    std::uint32_t kept_edges = 64;
};

/// A change of a line.
struct LineEdge {
    /// When, by MonotonicClock.
    std::int64_t time_us = 0;
    /// True if the line became active.
    bool active = false;
    /// Counts the edges of this line from 1 on, those that were lost too.
    std::uint32_t number = 0;
    /// How many between the one told before and this one were lost.
    std::uint32_t lost = 0;
};

namespace detail {

/// A line that is ours until it is closed; what both directions share.
template <class System>
class HeldLine {
public:
    HeldLine(const HeldLine&) = delete;
    HeldLine& operator=(const HeldLine&) = delete;

    void close() { static_cast<void>(close_file(system_, file_)); }
    bool is_open() const { return file_ >= 0; }
    /// For poll; -1 where the line is not open.
    int file() const { return file_; }
    /// After io_error with EBUSY: who has the line, in the words of the kernel; else empty.
    const char* holder() const { return holder_.c_str(); }
    /// Its `about` names the holder of a line that was taken, as long as the line object is there.
    const Fault& fault() const { return fault_; }

    /// The level now, of outputs as well.
    ///
    /// Errors  device_lost, io_error
    Result<bool> active();

protected:
    explicit HeldLine(System system) : system_(system) {}
    ~HeldLine() { close(); }

    Status fail(const char* call, int error, Status status, const char* about = "") {
        fault_ = {call, error, status, about};
        return status;
    }
    /// A chip that is gone takes its lines with it.
    Status refuse(const char* call, std::ptrdiff_t answer, const char* about = "");
    Status hold(GpioChip<System>& chip, const char* line, const char* role, gpio_v2_line_request& request);

    System system_;
    int file_ = -1;
    Text<GPIO_MAX_NAME_SIZE> holder_;
    Fault fault_;
};

}  // namespace detail

/// A line that is driven. When it is closed, or the program ends, most chips keep its level: set it inactive
/// before.
template <class System = Kernel>
class OutputLine : public detail::HeldLine<System> {
public:
    explicit OutputLine(System system = {}) : detail::HeldLine<System>(system) {}

    /// Takes a line of a chip, by number or name, for a role ("ok", "light"); it is inactive from the moment
    /// on at which it is driven. Others see "fovea:<role>" as its holder, of 31 bytes at most.
    ///
    /// Errors  as GpioChip::line(); io_error with EBUSY where it is taken; unsupported for what the chip
    ///         cannot do
    Status open(GpioChip<System>& chip, const char* line, const char* role,
                const OutputLineOptions& options = {});

    /// As hal/digital_pin.hpp has it. After device_lost the line is closed.
    Status set(bool active);
};

/// A line that is watched.
template <class System = Kernel>
class InputLine : public detail::HeldLine<System> {
public:
    explicit InputLine(System system = {}) : detail::HeldLine<System>(system) {}

    /// As OutputLine::open(). What happened before is not told.
    Status open(GpioChip<System>& chip, const char* line, const char* role,
                const InputLineOptions& options = {});

    /// The oldest edge that was not taken yet; a poll of file() wakes for it.
    ///
    /// Errors  not_found where there is none; device_lost, with the line closed; io_error
    Status next_edge(LineEdge& edge);

    /// As hal/digital_pin.hpp has it: takes all edges, also those that next_edge() would give. Edges that
    /// were lost count: there was at least one activation among them, or it is the edge that follows.
    Result<bool> take_edge();

    /// How many edges were lost since the line was opened.
    std::uint64_t lost_edges() const { return lost_; }

private:
    /// A line that never rests must not keep the caller: the others come with the next call.
    static constexpr int most_at_once = 1024;

    std::uint32_t last_number_ = 0;
    std::uint64_t lost_ = 0;
};

static_assert(hal::is_output_pin_v<OutputLine<>> && hal::is_input_pin_v<OutputLine<>>);
static_assert(hal::is_input_pin_v<InputLine<>> && hal::is_edge_pin_v<InputLine<>>);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class System>
Status HeldLine<System>::refuse(const char* call, std::ptrdiff_t answer, const char* about) {
    const int error = static_cast<int>(-answer);
    const Status status = fail(call, error, status_of(error), about);
    if (status == Status::device_lost) close();
    return status;
}

template <class System>
Status HeldLine<System>::hold(GpioChip<System>& chip, const char* line, const char* role,
                              gpio_v2_line_request& request) {
    close();
    fault_ = {};
    holder_.clear();
    const Result<std::uint32_t> number = chip.line(line);
    if (!number) {
        fault_ = chip.fault();
        return number.status();
    }
    request.offsets[0] = *number;
    request.num_lines = 1;
    const Text<GPIO_MAX_NAME_SIZE - 1> consumer = Text<GPIO_MAX_NAME_SIZE - 1>("fovea:").add(role);
    std::memcpy(request.consumer, consumer.c_str(), static_cast<std::size_t>(consumer.size()));
    const int got =
        uninterrupted([&] { return system_.ioctl(chip.file(), GPIO_V2_GET_LINE_IOCTL, &request); });
    if (got >= 0) {
        file_ = request.fd;
        return Status::ok;
    }
    if (got == -EBUSY) {
        gpio_v2_line_info info{};
        info.offset = *number;
        const int told =
            uninterrupted([&] { return system_.ioctl(chip.file(), GPIO_V2_GET_LINEINFO_IOCTL, &info); });
        info.consumer[sizeof info.consumer - 1] = '\0';
        if (told >= 0) holder_.add(info.consumer);
    }
    // Drivers say ENOTSUPP, which is the kernel's own, for what a chip cannot do.
    constexpr int not_supported = 524;
    const bool cannot = got == -EINVAL || got == -not_supported;
    return fail("GPIO_GET_LINE", -got, cannot ? Status::unsupported : status_of(-got), holder_.c_str());
}

template <class System>
Result<bool> HeldLine<System>::active() {
    if (file_ < 0) return Status::device_lost;
    gpio_v2_line_values values{};
    values.mask = 1;
    const int got =
        uninterrupted([&] { return system_.ioctl(file_, GPIO_V2_LINE_GET_VALUES_IOCTL, &values); });
    if (got < 0) return refuse("GPIO_V2_LINE_GET_VALUES", got);
    return (values.bits & 1) != 0;
}

}  // namespace detail

template <class System>
Status OutputLine<System>::open(GpioChip<System>& chip, const char* line, const char* role,
                                const OutputLineOptions& options) {
    gpio_v2_line_request request{};
    // Without an attribute for its value, the kernel drives it inactive.
    request.config.flags = GPIO_V2_LINE_FLAG_OUTPUT;
    if (options.active == LineLevel::low) request.config.flags |= GPIO_V2_LINE_FLAG_ACTIVE_LOW;
    if (options.drive == LineDrive::open_drain) request.config.flags |= GPIO_V2_LINE_FLAG_OPEN_DRAIN;
    if (options.drive == LineDrive::open_source) request.config.flags |= GPIO_V2_LINE_FLAG_OPEN_SOURCE;
    return this->hold(chip, line, role, request);
}

template <class System>
Status OutputLine<System>::set(bool active) {
    if (!this->is_open()) return Status::device_lost;
    gpio_v2_line_values values{};
    values.mask = 1;
    values.bits = active ? 1 : 0;
    const int got = uninterrupted(
        [&] { return this->system_.ioctl(this->file_, GPIO_V2_LINE_SET_VALUES_IOCTL, &values); });
    return got < 0 ? this->refuse("GPIO_V2_LINE_SET_VALUES", got) : Status::ok;
}

template <class System>
Status InputLine<System>::open(GpioChip<System>& chip, const char* line, const char* role,
                               const InputLineOptions& options) {
    gpio_v2_line_request request{};
    request.event_buffer_size = options.kept_edges;
    gpio_v2_line_config& config = request.config;
    config.flags = GPIO_V2_LINE_FLAG_INPUT | GPIO_V2_LINE_FLAG_EDGE_RISING;
    if (options.edges == LineEdges::both) config.flags |= GPIO_V2_LINE_FLAG_EDGE_FALLING;
    if (options.active == LineLevel::low) config.flags |= GPIO_V2_LINE_FLAG_ACTIVE_LOW;
    if (options.bias == LineBias::none) config.flags |= GPIO_V2_LINE_FLAG_BIAS_DISABLED;
    if (options.bias == LineBias::pull_up) config.flags |= GPIO_V2_LINE_FLAG_BIAS_PULL_UP;
    if (options.bias == LineBias::pull_down) config.flags |= GPIO_V2_LINE_FLAG_BIAS_PULL_DOWN;
    if (options.debounce_us != 0) {
        config.num_attrs = 1;
        config.attrs[0].attr.id = GPIO_V2_LINE_ATTR_ID_DEBOUNCE;
        config.attrs[0].attr.debounce_period_us = options.debounce_us;
        config.attrs[0].mask = 1;
    }
    last_number_ = 0;
    lost_ = 0;
    if (const Status s = this->hold(chip, line, role, request); s != Status::ok) return s;
    const int got = uninterrupted([&] { return this->system_.stop_waiting(this->file_); });
    if (got >= 0) return Status::ok;
    this->close();
    return this->refuse("fcntl", got);
}

template <class System>
Status InputLine<System>::next_edge(LineEdge& edge) {
    if (!this->is_open()) return Status::device_lost;
    gpio_v2_line_event event{};
    const Span<std::uint8_t> bytes(reinterpret_cast<std::uint8_t*>(&event), sizeof event);
    const std::ptrdiff_t got = uninterrupted([&] { return this->system_.read(this->file_, bytes); });
    if (got == -EAGAIN) return Status::not_found;
    if (got < 0) return this->refuse("read", got);
    if (got == 0) return this->refuse("read", -ENODEV, "the line has ended");
    if (got != bytes.size()) return this->fail("read", 0, Status::io_error, "a part of an edge");
    // Numbers begin again behind the largest; one that stands still would be the driver's mistake, and none
    // is lost.
    const std::uint32_t step = event.line_seqno - last_number_;
    const std::uint32_t lost = step == 0 || step > 0x80000000u ? 0 : step - 1;
    last_number_ = event.line_seqno;
    lost_ += lost;
    edge = {static_cast<std::int64_t>(event.timestamp_ns / 1000), event.id == GPIO_V2_LINE_EVENT_RISING_EDGE,
            event.line_seqno, lost};
    return Status::ok;
}

template <class System>
Result<bool> InputLine<System>::take_edge() {
    bool taken = false;
    LineEdge edge;
    for (int i = 0; i < most_at_once; ++i) {
        const Status status = next_edge(edge);
        if (status == Status::not_found) break;
        // What was taken counts: the error comes again with the next call.
        if (status != Status::ok) return taken ? Result<bool>(true) : Result<bool>(status);
        taken = taken || edge.active || edge.lost > 0;
    }
    return taken;
}

}  // namespace fovea::linux_port
