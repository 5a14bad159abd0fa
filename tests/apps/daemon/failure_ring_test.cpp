// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <time.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <fovea/codec/pnm.hpp>

#include <daemon/failure_ring.hpp>

#include "support/failing_system.hpp"
#include "support/guarded_image.hpp"
#include "support/temporary_folder.hpp"

namespace fovea::apps {
namespace {

using linux_port::Kernel;
using test::TemporaryFolder;

constexpr Size size{30, 20};

Span<const char> text(const char* from) { return {from, static_cast<std::ptrdiff_t>(std::strlen(from))}; }

void sleep_ms(int milliseconds) {
    const timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000};
    ::nanosleep(&time, nullptr);
}

/// A disk on which writing hangs until a test lets it go on.
class HangingKernel : public Kernel {
public:
    explicit HangingKernel(std::atomic<bool>& hangs) : hangs_(&hangs) {}
    int sync(int file) {
        while (*hangs_) sleep_ms(1);
        return Kernel::sync(file);
    }

private:
    std::atomic<bool>* hangs_;
};

test::GuardedImage<Gray8> picture(int level) {
    test::GuardedImage<Gray8> made(size);
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) made(x, y) = static_cast<Gray8>(level + x);
    return made;
}

TEST(FailureRing, KeepsThePicturesOfFailures) {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(FailureRing<>::memory_bytes(4, size)));
    linux_port::RingLimits limits;
    limits.pairs = 3;
    FailureRing<> ring;
    ASSERT_EQ(ring.start(folder.path(), limits, 4, size,
                         {memory.data(), static_cast<std::ptrdiff_t>(memory.size())}),
              Status::ok);
    for (int k = 0; k < 6; ++k) {
        const std::string told = "{\"frame\":" + std::to_string(k) + "}";
        auto image = picture(k);
        while (ring.offer(image.view(), text(told.c_str())) != Status::ok) sleep_ms(1);
    }
    ASSERT_EQ(ring.stop(10000000), Status::ok);
    EXPECT_EQ(ring.stored(), 6u);
    EXPECT_EQ(folder.names().size(), 6u);
    EXPECT_EQ(folder.read("00000005.json"), "{\"frame\":5}");
    const std::string file = folder.read("00000005.pgm");
    test::GuardedImage<Gray8> read(size);
    ASSERT_EQ(decode_pnm({reinterpret_cast<const std::uint8_t*>(file.data()),
                          static_cast<std::ptrdiff_t>(file.size())},
                         read.view()),
              Status::ok);
    EXPECT_EQ(read(29, 19), 34);
    FailureRingEvent event;
    EXPECT_FALSE(ring.take_event(event));
}

TEST(FailureRing, NeverWaitsForADiskThatHangs) {
    const TemporaryFolder folder;
    std::atomic<bool> hangs{true};
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(FailureRing<>::memory_bytes(2, size)));
    FailureRing<HangingKernel> ring{HangingKernel(hangs)};
    ASSERT_EQ(
        ring.start(folder.path(), {}, 2, size, {memory.data(), static_cast<std::ptrdiff_t>(memory.size())}),
        Status::ok);
    auto image = picture(1);
    Kernel kernel;
    std::int64_t longest_us = 0;
    for (int k = 0; k < 200; ++k) {
        const std::int64_t start_us = kernel.monotonic_us();
        static_cast<void>(ring.offer(image.view(), text("{}")));
        longest_us = std::max(longest_us, kernel.monotonic_us() - start_us);
    }
    EXPECT_EQ(ring.dropped(), 198u);
    EXPECT_LT(longest_us, 1000000);
    EXPECT_EQ(ring.stop(10000), Status::timeout);
    hangs = false;
    EXPECT_EQ(ring.stop(10000000), Status::ok);
    for (const std::string& name : folder.names()) EXPECT_EQ(name.find(".new"), std::string::npos);
}

TEST(FailureRing, RefusesWhatHasNoPlace) {
    const TemporaryFolder folder;
    std::vector<std::uint8_t> memory(static_cast<std::size_t>(FailureRing<>::memory_bytes(1, size)));
    const Span<std::uint8_t> all(memory.data(), static_cast<std::ptrdiff_t>(memory.size()));
    FailureRing<> ring;
    EXPECT_EQ(ring.start(folder.path(), {}, 2, size, all), Status::scratch_too_small);
    EXPECT_EQ(ring.start("", {}, 1, size, all), Status::bad_argument);
    ASSERT_EQ(ring.start(folder.path(), {}, 1, size, all), Status::ok);
    test::GuardedImage<Gray8> large({31, 20});
    EXPECT_EQ(ring.offer(large.view(), text("{}")), Status::buffer_too_small);
    EXPECT_EQ(ring.offer({}, text("{}")), Status::empty_image);
    const std::string endless(FailureRing<>::most_text + 1, 'x');
    EXPECT_EQ(ring.offer(picture(1).view(), text(endless.c_str())), Status::buffer_too_small);
    EXPECT_EQ(ring.dropped(), 0u);
    EXPECT_EQ(ring.stop(10000000), Status::ok);
    EXPECT_TRUE(folder.names().empty());
}

/// A job of a few bytes.
struct Job {
    std::uint8_t bytes[4] = {1, 2, 3, 4};
    linux_port::WritingJob job() { return {{bytes, 3}, {bytes + 3, 1}}; }
};

TEST(RingKeeper, TellsOfAFullDiskOnceAndOfItsEndOnce) {
    for (const int error : {ENOSPC, EROFS, EDQUOT}) {
        const TemporaryFolder folder;
        test::SystemScript script;
        RingKeeper<test::FailingSystem<>> keeper{test::FailingSystem<>(script)};
        ASSERT_EQ(keeper.open(folder.path(), {}), Status::ok);
        Job job;
        keeper(job.job());
        FailureRingEvent event;
        EXPECT_FALSE(keeper.take_event(event));
        script.fail_at = script.calls + 5;  // somewhere in the midst, and from then on
        script.error = error;
        script.for_ever = true;
        for (int k = 0; k < 10; ++k) keeper(job.job());
        EXPECT_EQ(keeper.failed(), 10u);
        ASSERT_TRUE(keeper.take_event(event));
        EXPECT_EQ(event.fault.error, error);
        EXPECT_STRNE(linux_port::advice(event.fault), "");
        EXPECT_FALSE(keeper.take_event(event));
        script.fail_at = 0;
        for (int k = 0; k < 3; ++k) keeper(job.job());
        ASSERT_TRUE(keeper.take_event(event));
        EXPECT_EQ(event.status, Status::ok);
        EXPECT_FALSE(keeper.take_event(event));
        EXPECT_EQ(keeper.stored(), 4u);
        EXPECT_TRUE(script.all_given_back());
    }
}

TEST(RingKeeper, TellsWhatIsStillSoWhereNobodyListened) {
    const TemporaryFolder folder;
    test::SystemScript script;
    RingKeeper<test::FailingSystem<>> keeper{test::FailingSystem<>(script)};
    ASSERT_EQ(keeper.open(folder.path(), {}), Status::ok);
    Job job;
    script.for_ever = true;
    for (int k = 0; k < 20; ++k) {
        script.fail_at = k % 2 == 0 ? 1 : 0;
        keeper(job.job());
    }
    script.fail_at = 1;
    FailureRingEvent event;
    int events = 0;
    while (keeper.take_event(event)) ++events;
    EXPECT_EQ(events, 4);
    EXPECT_EQ(event.status, Status::ok) << "the fourth of fault, end, fault, end";
    keeper(job.job());
    ASSERT_TRUE(keeper.take_event(event));
    EXPECT_EQ(event.status, Status::io_error);
}

}  // namespace
}  // namespace fovea::apps
