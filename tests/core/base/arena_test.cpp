// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <fovea/base/arena.hpp>

namespace fovea::test {
namespace {

struct Counted {
    std::int64_t wide = 7;
    std::uint8_t narrow = 1;
};

TEST(Arena, AlignsInitialisesAndNeverLeavesItsBytes) {
    for (int shift = 0; shift < 8; ++shift) {
        std::vector<std::uint8_t> memory(512, 0xee);
        const auto needed = static_cast<std::ptrdiff_t>(
            arena_bytes<std::uint8_t>(3) + arena_bytes<Counted>(5) + arena_bytes<std::uint16_t>(2));
        Arena arena({memory.data() + shift, needed});
        const Span<std::uint8_t> bytes = arena.take<std::uint8_t>(3);
        const Span<Counted> counted = arena.take<Counted>(5);
        const Span<std::uint16_t> words = arena.take<std::uint16_t>(2);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(counted.data()) % alignof(Counted), 0u);
        EXPECT_EQ(bytes[2], 0);
        EXPECT_EQ(counted[4].wide, 7);
        EXPECT_EQ(words[1], 0);
        EXPECT_GE(reinterpret_cast<std::uint8_t*>(counted.data()), bytes.end());
        EXPECT_LE(reinterpret_cast<std::uint8_t*>(words.end()), memory.data() + shift + needed);
        EXPECT_EQ(memory[static_cast<std::size_t>(shift + needed)], 0xee);
    }
}

}  // namespace
}  // namespace fovea::test
