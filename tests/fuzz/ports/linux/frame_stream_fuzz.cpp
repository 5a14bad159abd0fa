// SPDX-License-Identifier: MIT
//
// Any bytes as a stream of frames, in pieces of a size that the first byte tells; and the same bytes at once,
// of which the stream must say the same.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/linux/frame_stream.hpp>
#include <fovea/linux/replay_picture.hpp>

#include "fuzz/codec/picture_fuzz.hpp"

namespace {

using namespace fovea;

/// A sum over all that was said, and the number of it.
struct Said {
    std::uint64_t sum = 0;
    int count = 0;

    void add(std::uint64_t value) { sum = sum * 1099511628211u + value + 1; }
    bool operator==(const Said& other) const { return sum == other.sum && count == other.count; }
};

Said listen(const linux_port::StreamFormat& format, std::ptrdiff_t room, Span<const std::uint8_t> bytes,
            std::ptrdiff_t piece) {
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(room));
    std::vector<std::uint8_t> picture_memory(3000);
    linux_port::FrameStream stream;
    fuzz::require(stream.begin(format, fuzz::room_in(memory)) == Status::ok);
    linux_port::ReplayPicture picture;
    picture.memory = fuzz::room_in(picture_memory);
    Said said;
    for (;;) {
        const Status status = stream.look();
        if (status == Status::timeout) {
            if (bytes.empty()) return said;
            const Span<std::uint8_t> into = stream.room();
            fuzz::require(!into.empty());
            const std::ptrdiff_t now = std::min({piece, into.size(), bytes.size()});
            std::copy_n(bytes.data(), now, into.data());
            stream.filled(now);
            bytes = bytes.from(now);
            continue;
        }
        ++said.count;
        said.add(static_cast<std::uint64_t>(status));
        if (status != Status::ok) continue;
        for (const std::uint8_t byte : stream.bytes()) said.add(byte);
        hal::FrameInfo info;
        if (format.format == hal::PixelFormat::none)
            said.add(static_cast<std::uint64_t>(picture.decode(stream.bytes(), info)));
        else
            stream.place(stream.bytes(), info);
        stream.drop();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t count) {
    if (count < 3) return 0;
    Span<const std::uint8_t> bytes(data, static_cast<std::ptrdiff_t>(count));
    linux_port::StreamFormat format;
    const std::ptrdiff_t piece = 1 + (bytes[0] & 0x7f);
    std::ptrdiff_t room = linux_port::FrameStream::max_header + bytes[1];
    if ((bytes[0] & 0x80) != 0) {
        const hal::PixelFormat formats[] = {hal::PixelFormat::gray8, hal::PixelFormat::yuyv,
                                            hal::PixelFormat::nv12, hal::PixelFormat::rgb24};
        format.format = formats[bytes[1] & 3];
        format.size = {1 + (bytes[1] >> 2 & 7), 1 + (bytes[1] >> 5)};
        format.behind = bytes[2] & 7;
        room = static_cast<std::ptrdiff_t>(format.frame_bytes()) + (bytes[2] >> 3);
    }
    fuzz::require(listen(format, room, bytes.from(3), piece) == listen(format, room, bytes.from(3), 1 << 20));
    return 0;
}
