// SPDX-License-Identifier: MIT
//
// Any bytes in both slots of a generation: what is loaded is whole, and what is saved then is loaded.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/base/crc32.hpp>
#include <fovea/linux/generations.hpp>
#include <support/memory_disk.hpp>

namespace {

using namespace fovea;
using Bytes = std::vector<std::uint8_t>;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

/// With the right checksum where a bit says so: otherwise nothing but its check would be seen.
Bytes slot(const std::uint8_t* data, std::size_t size, bool mend) {
    Bytes bytes(data, data + size);
    if (!mend || size < 20) return bytes;
    Crc32 crc;
    crc.add(Span<const std::uint8_t>(bytes.data(), 16));
    crc.add(Span<const std::uint8_t>(bytes.data() + 20, static_cast<std::ptrdiff_t>(size - 20)));
    for (int i = 0; i < 4; ++i)
        bytes[static_cast<std::size_t>(16 + i)] = static_cast<std::uint8_t>(crc.value() >> (8 * i));
    return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const std::size_t first = std::min<std::size_t>(data[1], size - 2);
    test::MemoryDisk disk;
    if ((data[0] & 1) != 0) disk.put("job.a", slot(data + 2, first, (data[0] & 2) != 0));
    if ((data[0] & 4) != 0) disk.put("job.b", slot(data + 2 + first, size - 2 - first, (data[0] & 8) != 0));
    Bytes memory(std::size_t{data[0]} >> 4 << 3);
    linux_port::GenerationStorage storage(test::DiskSystem{&disk},
                                          {memory.data(), static_cast<std::ptrdiff_t>(memory.size())});
    const Result<Span<const std::uint8_t>> found = storage.load("job");
    require(disk.open_files() == 0);
    if (found) {
        // One of the files holds it behind its head, and is no longer.
        bool held = false;
        for (const char* name : {"job.a", "job.b"}) {
            const Bytes* const file = disk.content(name);
            held |= file != nullptr && file->size() == 20 + static_cast<std::size_t>(found->size()) &&
                    std::equal(found->begin(), found->end(), file->begin() + 20);
        }
        require(held);
    } else {
        require(found.status() != Status::ok && storage.fault().status == found.status());
    }
    const Bytes fresh(std::min<std::size_t>(memory.size(), 3), 0x5a);
    require(storage.save("job", {fresh.data(), static_cast<std::ptrdiff_t>(fresh.size())}) == Status::ok);
    const Result<Span<const std::uint8_t>> now = storage.load("job");
    require(now.ok() && Bytes(now->begin(), now->end()) == fresh);
    return 0;
}
