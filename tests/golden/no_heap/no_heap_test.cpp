// SPDX-License-Identifier: MIT
//
// The core takes no memory of its own: all golden vectors run while every way to the heap stops the program.
// In a program of its own, because it replaces these ways.
#include <gtest/gtest.h>

#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <new>

#include <golden/vectors.hpp>

#if defined(__SANITIZE_ADDRESS__)
#define FOVEA_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FOVEA_ADDRESS_SANITIZER
#endif
#endif

namespace {

bool armed = false;

/// Without a heap: what it prints with may want one.
void trap(const char* way) {
    if (!armed) return;
    armed = false;
    constexpr char text[] = "memory was asked for by ";
    static_cast<void>(!write(STDERR_FILENO, text, sizeof text - 1));
    static_cast<void>(!write(STDERR_FILENO, way, std::strlen(way)));
    static_cast<void>(!write(STDERR_FILENO, "\n", 1));
    std::abort();
}

}  // namespace

#if defined(FOVEA_ADDRESS_SANITIZER)

// The sanitizer owns the heap, and tells whoever asks.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*malloc_hook)(const volatile void*,
                                                                             std::size_t),
                                                         void (*free_hook)(const volatile void*));
namespace {
const int hooked = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, std::size_t) { trap("the heap"); }, [](const volatile void*) {});
}  // namespace

#else

// The names under which the C library keeps its own.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) {
    trap("malloc");
    return __libc_malloc(bytes);
}
void* calloc(std::size_t count, std::size_t bytes) {
    trap("calloc");
    return __libc_calloc(count, bytes);
}
void* realloc(void* memory, std::size_t bytes) {
    trap("realloc");
    return __libc_realloc(memory, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) {
    trap("aligned_alloc");
    return __libc_memalign(alignment, bytes);
}
void* mmap(void* address, std::size_t bytes, int protection, int flags, int file, off_t offset) {
    trap("mmap");
    return reinterpret_cast<void*>(syscall(SYS_mmap, address, bytes, protection, flags, file, offset));
}
}

#endif

namespace fovea::golden {
namespace {

Workspace workspace;

TEST(NoHeap, EveryGoldenVectorRunsWithoutMemoryOfItsOwn) {
    std::uint32_t all = 0;
    armed = true;
    for (const Vector& vector : vectors) all ^= checksum(vector, workspace);
    armed = false;
    EXPECT_NE(all, 0u);
}

/// Hides from the compiler that nobody uses the memory, so that it must ask for it.
template <class T>
void keep(T* memory) {
    asm volatile("" : : "r"(memory) : "memory");
}

template <class Ask>
void ask_armed(Ask ask) {
    armed = true;
    ask();
    armed = false;
}

TEST(NoHeapAlarm, RingsForEveryWayToTheHeap) {
    EXPECT_DEATH(ask_armed([] { keep(std::malloc(9)); }), "memory was asked for by");
    EXPECT_DEATH(ask_armed([] { keep(std::calloc(9, 9)); }), "memory was asked for by");
    void* old = std::malloc(9);
    EXPECT_DEATH(ask_armed([&] { keep(std::realloc(old, 99)); }), "memory was asked for by");
    std::free(old);
    EXPECT_DEATH(ask_armed([] { keep(std::aligned_alloc(16, 32)); }), "memory was asked for by");
    EXPECT_DEATH(ask_armed([] { keep(new int(7)); }), "memory was asked for by");
    EXPECT_DEATH(ask_armed([] { keep(new int[9]); }), "memory was asked for by");
    EXPECT_DEATH(ask_armed([] { keep(::operator new (9, std::align_val_t{64})); }),
                 "memory was asked for by");
}

#if !defined(FOVEA_ADDRESS_SANITIZER)
TEST(NoHeapAlarm, RingsForPages) {
    EXPECT_DEATH(ask_armed([] { keep(mmap(nullptr, 4096, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)); }),
                 "memory was asked for by mmap");
}
#endif

}  // namespace
}  // namespace fovea::golden
