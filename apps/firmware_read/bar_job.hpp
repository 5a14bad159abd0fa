// SPDX-License-Identifier: MIT
//
// What a board does with the lines of a frame in which it reads bar codes. No frame is ever in its memory.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/bar_stream.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/image/geometry.hpp>

#include <firmware/frame_firmware.hpp>
#include <firmware_read/frame_codes.hpp>

namespace fovea::apps {

/// All memory but the stack: 13 KiB of scratch for lines of 640 pixels.
template <int Width>
struct BarMemory {
    static constexpr int width = Width;
    alignas(8) std::uint8_t scratch[static_cast<std::size_t>(bar_stream_scratch(Width))];
};

/// The job of FrameFirmware. It takes lines of 32 pixels and more; of two of them it looks at one.
template <class Memory>
class BarJob {
public:
    static constexpr bool takes_recipes = false;
    static constexpr int least_width = 32;  ///< less has no room for a bar code

    BarJob(Memory& memory, SymbologySet symbologies)
        : memory_(memory), symbologies_(symbologies), stream_(fresh(Memory::width)) {}

    /// A line arrives in what is idle of the stream, and is taken before the stream needs that.
    Span<std::uint8_t> packet_room() const {
        const Span<std::uint8_t> idle = stream_.idle_scratch();
        static_assert(line_packet_bytes(least_width) <= 8 * least_width, "a line must find room");
        return idle.first(line_packet_bytes(idle.size() / 8));
    }

    const char* load(Span<const std::uint8_t> in_flash) { return codes_.allow(in_flash); }
    const char* missing() const { return codes_.missing(); }

    const char* begin(Size size) {
        if (size.width > Memory::width || size.height > max_image_side) return "frame too large";
        if (size.width < least_width) return "frame too narrow";
        stream_ = fresh(size.width);
        codes_.clear();
        return nullptr;
    }
    /// No status is lost: a stream that has one answers it at the end.
    void take_line(int, Span<const std::uint8_t> pixels) { static_cast<void>(stream_.take(pixels)); }

    const char* judge(Verdict& verdict) {
        return codes_.judge(stream_.finish(codes_.text(), codes_.codes()), stream_.idle_scratch(), verdict);
    }

    template <class Line>
    void tell_judged(Line& line) const {
        codes_.tell(line, stream_.idle_scratch());
    }
    template <class Line>
    void tell_state(Line& line) const {
        line.text(",\"reads\":\"bars\"");
        codes_.tell_allowed(line);
        line.text(",\"line_bytes\":").number(Memory::width);
    }

private:
    BarStream fresh(int width) const {
        BarStreamOptions options;
        options.rules.symbologies = symbologies_;
        return {width, options, memory_.scratch};
    }

    /// Two texts of the longest kind.
    using Codes = FrameCodes<2, 2 * most_bar_text>;
    static_assert(Codes::utf8_bytes <= 8 * Memory::width, "a text must find room as UTF-8");

    Memory& memory_;
    SymbologySet symbologies_;
    BarStream stream_;
    Codes codes_;
};

}  // namespace fovea::apps
