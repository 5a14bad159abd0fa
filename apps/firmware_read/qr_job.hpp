// SPDX-License-Identifier: MIT
//
// What a board does with frames in which it reads QR codes.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/read_qr.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/image_view.hpp>

#include <firmware/frame_firmware.hpp>
#include <firmware_read/frame_codes.hpp>

namespace fovea::apps {

/// A whole frame of Width x Height pixels, what reading codes up to a version takes, and how many bytes the
/// texts of a frame may have: version 6 holds up to 322.
template <int Width, int Height, int LargestVersion, std::size_t TextBytes>
struct QrMemory {
    static constexpr Size size{Width, Height};
    static constexpr int line_bytes = Width;
    static constexpr int largest_version = LargestVersion;
    static constexpr std::size_t text_bytes = TextBytes;
    static constexpr int most_told = 2;  ///< codes of a frame; with more of them there is no verdict

    static constexpr ReadQrOptions options() {
        ReadQrOptions options;
        options.effort = ReadQrOptions::Effort::several;
        options.most_codes = most_told + 1;
        options.largest_version = LargestVersion;
        return options;
    }
    std::uint8_t frame[static_cast<std::size_t>(size.area())];
    /// Of the reader; until a frame is whole, of the packet that arrives.
    alignas(8) std::uint8_t scratch[static_cast<std::size_t>(read_qr_scratch(size, options()))];
};

/// The job of FrameFirmware. A frame may have any sides that need no more memory than the largest one.
template <class Memory>
class QrJob {
public:
    static constexpr bool takes_recipes = false;

    explicit QrJob(Memory& memory) : memory_(memory) {}

    Span<std::uint8_t> packet_room() {
        constexpr std::ptrdiff_t room = line_packet_bytes(Memory::line_bytes);
        static_assert(room <= std::ptrdiff_t{sizeof(Memory::scratch)}, "a line must find room");
        return {memory_.scratch, room};
    }

    const char* load(Span<const std::uint8_t> in_flash) { return codes_.allow(in_flash); }
    const char* missing() const { return codes_.missing(); }

    const char* begin(Size size) {
        const bool fits = size.width <= Memory::line_bytes && size.area() <= Memory::size.area() &&
                          read_qr_scratch(size, Memory::options()) <= std::int64_t{sizeof memory_.scratch};
        if (!fits) return "frame too large";
        size_ = size;
        codes_.clear();
        return nullptr;
    }
    void take_line(int y, Span<const std::uint8_t> pixels) {
        std::uint8_t* row = memory_.frame + std::ptrdiff_t{y} * size_.width;
        for (int x = 0; x < size_.width; ++x) row[x] = pixels[x];
    }

    const char* judge(Verdict& verdict) {
        const ImageView<const Gray8> image(memory_.frame, size_, size_.width);
        const Status status =
            read_qr(image, Memory::options(), memory_.scratch, codes_.text(), codes_.codes());
        return codes_.judge(status, memory_.scratch, verdict);
    }

    template <class Line>
    void tell_judged(Line& line) const {
        codes_.tell(line, memory_.scratch);
    }
    template <class Line>
    void tell_state(Line& line) const {
        line.text(",\"reads\":\"qr\",\"largest_version\":").number(Memory::largest_version);
        codes_.tell_allowed(line);
        line.text(",\"frame_bytes\":").number(Memory::size.area());
        line.text(",\"line_bytes\":").number(Memory::line_bytes);
    }

private:
    using Codes = FrameCodes<Memory::most_told, Memory::text_bytes>;
    static_assert(Codes::utf8_bytes <= std::int64_t{sizeof(Memory::scratch)},
                  "a text must find room as UTF-8");

    Memory& memory_;
    Size size_{};
    Codes codes_;
};

}  // namespace fovea::apps
