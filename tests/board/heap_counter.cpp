// SPDX-License-Identifier: MIT
//
// Linked into a program, this is its heap: it counts every call, and SIGUSR1 lets it say so: "heap calls N".
// Nothing is ever given back.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace {

constexpr std::size_t room = std::size_t{256} << 20;
alignas(16) unsigned char heap[room];
std::size_t used = 0;
volatile std::uint32_t calls = 0;

void* take(std::size_t bytes, std::size_t alignment) {
    calls = calls + 1;
    // In front of the bytes stands how many they are.
    const std::size_t begin = (used + sizeof(std::size_t) + alignment - 1) / alignment * alignment;
    if (bytes > room || begin > room - bytes) return nullptr;
    used = begin + bytes;
    std::memcpy(heap + begin - sizeof(std::size_t), &bytes, sizeof bytes);
    return heap + begin;
}

void tell(int) {
    char text[40] = "heap calls ";
    char digits[12];
    int count = 0;
    for (std::uint32_t rest = calls; rest != 0 || count == 0; rest /= 10)
        digits[count++] = static_cast<char>('0' + rest % 10);
    int size = 11;
    while (count > 0) text[size++] = digits[--count];
    text[size++] = '\n';
    if (::write(2, text, static_cast<std::size_t>(size)) < 0) _exit(99);
}

[[gnu::constructor]] void listen() { std::signal(SIGUSR1, tell); }

}  // namespace

extern "C" {
void* malloc(std::size_t bytes) { return take(bytes, 16); }
void free(void*) { calls = calls + 1; }
void* calloc(std::size_t count, std::size_t bytes) { return take(count * bytes, 16); }
void* memalign(std::size_t alignment, std::size_t bytes) {
    return take(bytes, std::max<std::size_t>(alignment, 16));
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) { return memalign(alignment, bytes); }
int posix_memalign(void** memory, std::size_t alignment, std::size_t bytes) {
    *memory = memalign(alignment, bytes);
    return *memory == nullptr ? 12 : 0;
}
void* realloc(void* old, std::size_t bytes) {
    void* const fresh = take(bytes, 16);
    if (old == nullptr || fresh == nullptr) return fresh;
    std::size_t before = 0;
    std::memcpy(&before, static_cast<unsigned char*>(old) - sizeof before, sizeof before);
    std::memcpy(fresh, old, std::min(before, bytes));
    return fresh;
}
}
