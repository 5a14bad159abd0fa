// SPDX-License-Identifier: MIT
//
// Any bytes as a calibration of a chip, as they come and with a right head and checksum: what is refused
// changes nothing, what is read is written as the same bytes, and a map can be asked of it.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/camera/packed_camera.hpp>
#include <fovea/camera/undistortion_map.hpp>

namespace {

using namespace fovea;

using Bytes = std::vector<std::uint8_t>;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

void read(const Bytes& bytes) {
    CameraSet set;
    set.sizes[0] = {7, 7};
    const Span<const std::uint8_t> span(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
    const Status status = unpack_cameras(span, set);
    if (status != Status::ok) {
        require(set.count == 1 && set.sizes[0] == Size{7, 7});
        return;
    }
    std::uint8_t again[packed_camera_bytes(2)];
    const Result<std::ptrdiff_t> size = pack_cameras(set, again);
    require(size.ok() && *size == span.size());
    for (std::ptrdiff_t i = 0; i < *size; ++i) require(again[i] == span[i]);

    const Camera<>& camera = set.cameras[set.count - 1];
    const auto map =
        undistortion_map(LensInverse<>(camera), set.right_from_left.rotation, set.cameras[0], {64, 48});
    if (!map) return;
    FinePoint row[64];
    require(map->row(17, row) == Status::ok);
    for (const FinePoint& place : row) {
        if (place == no_fine_point) continue;
        require(place.x.raw() >= -(32767 << 16) && place.x.raw() <= 32767 << 16);
        require(place.y.raw() >= -(32767 << 16) && place.y.raw() <= 32767 << 16);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    read(Bytes(data, data + size));
    for (int cameras = 1; cameras <= 2; ++cameras) {
        Bytes whole = {'F', 'V', 'C', 'M', 1, static_cast<std::uint8_t>(cameras), 0, 0};
        const std::ptrdiff_t length = packed_camera_bytes(cameras);
        whole[6] = static_cast<std::uint8_t>(length & 255);
        whole[7] = static_cast<std::uint8_t>(length >> 8);
        for (std::size_t i = 0; whole.size() + 4 < static_cast<std::size_t>(length); ++i)
            whole.push_back(i < size ? data[i] : 0);
        const std::uint32_t sum = crc32({whole.data(), static_cast<std::ptrdiff_t>(whole.size())});
        for (int i = 0; i < 4; ++i) whole.push_back(static_cast<std::uint8_t>(sum >> 8 * i));
        read(whole);
    }
    return 0;
}
