// SPDX-License-Identifier: MIT
//
// The four functions of memory that a compiler calls of its own accord, and the names that Arm's run-time ABI
// has for them (RTABI32, sec. 4.3.4). This file is compiled so that their bodies do not become calls of
// themselves.
#include <cstddef>
#include <cstdint>

namespace {

using Word [[gnu::may_alias]] = std::uint32_t;

bool aligned(const void* first, const void* second) {
    return ((reinterpret_cast<std::uintptr_t>(first) | reinterpret_cast<std::uintptr_t>(second)) & 3) == 0;
}

}  // namespace

extern "C" {

void* memcpy(void* to, const void* from, std::size_t bytes) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    if (((reinterpret_cast<std::uintptr_t>(out) ^ reinterpret_cast<std::uintptr_t>(in)) & 3) == 0) {
        for (; bytes > 0 && !aligned(out, out); --bytes) *out++ = *in++;
        auto* out_words = reinterpret_cast<Word*>(out);
        const auto* in_words = reinterpret_cast<const Word*>(in);
        for (; bytes >= 16; bytes -= 16, out_words += 4, in_words += 4) {
            const Word first = in_words[0], second = in_words[1], third = in_words[2], fourth = in_words[3];
            out_words[0] = first;
            out_words[1] = second;
            out_words[2] = third;
            out_words[3] = fourth;
        }
        for (; bytes >= 4; bytes -= 4) *out_words++ = *in_words++;
        out = reinterpret_cast<unsigned char*>(out_words);
        in = reinterpret_cast<const unsigned char*>(in_words);
    }
    while (bytes-- > 0) *out++ = *in++;
    return to;
}

void* memmove(void* to, const void* from, std::size_t bytes) {
    auto* out = static_cast<unsigned char*>(to);
    const auto* in = static_cast<const unsigned char*>(from);
    // Forwards is right unless the target begins inside the source.
    if (reinterpret_cast<std::uintptr_t>(out) - reinterpret_cast<std::uintptr_t>(in) >= bytes)
        return memcpy(to, from, bytes);
    if (aligned(out + bytes, in + bytes))
        for (; bytes >= 4; bytes -= 4)
            *reinterpret_cast<Word*>(out + bytes - 4) = *reinterpret_cast<const Word*>(in + bytes - 4);
    while (bytes-- > 0) out[bytes] = in[bytes];
    return to;
}

void* memset(void* to, int value, std::size_t bytes) {
    auto* out = static_cast<unsigned char*>(to);
    const auto byte = static_cast<unsigned char>(value);
    for (; bytes > 0 && !aligned(out, out); --bytes) *out++ = byte;
    auto* words = reinterpret_cast<Word*>(out);
    const Word four = byte * 0x01010101u;
    for (; bytes >= 32; bytes -= 32, words += 8) {
        words[0] = words[1] = words[2] = words[3] = four;
        words[4] = words[5] = words[6] = words[7] = four;
    }
    for (; bytes >= 4; bytes -= 4) *words++ = four;
    out = reinterpret_cast<unsigned char*>(words);
    while (bytes-- > 0) *out++ = byte;
    return to;
}

int memcmp(const void* first, const void* second, std::size_t bytes) {
    const auto* left = static_cast<const unsigned char*>(first);
    const auto* right = static_cast<const unsigned char*>(second);
    for (; bytes > 0; --bytes, ++left, ++right)
        if (*left != *right) return *left < *right ? -1 : 1;
    return 0;
}

#if defined(__arm__)
void __aeabi_memcpy(void* to, const void* from, std::size_t bytes) { memcpy(to, from, bytes); }
void __aeabi_memcpy4(void* to, const void* from, std::size_t bytes) { memcpy(to, from, bytes); }
void __aeabi_memcpy8(void* to, const void* from, std::size_t bytes) { memcpy(to, from, bytes); }
void __aeabi_memmove(void* to, const void* from, std::size_t bytes) { memmove(to, from, bytes); }
void __aeabi_memmove4(void* to, const void* from, std::size_t bytes) { memmove(to, from, bytes); }
void __aeabi_memmove8(void* to, const void* from, std::size_t bytes) { memmove(to, from, bytes); }
// The value comes last here.
void __aeabi_memset(void* to, std::size_t bytes, int value) { memset(to, value, bytes); }
void __aeabi_memset4(void* to, std::size_t bytes, int value) { memset(to, value, bytes); }
void __aeabi_memset8(void* to, std::size_t bytes, int value) { memset(to, value, bytes); }
void __aeabi_memclr(void* to, std::size_t bytes) { memset(to, 0, bytes); }
void __aeabi_memclr4(void* to, std::size_t bytes) { memset(to, 0, bytes); }
void __aeabi_memclr8(void* to, std::size_t bytes) { memset(to, 0, bytes); }
#endif
}
