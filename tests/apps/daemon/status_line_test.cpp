// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include <daemon/status_line.hpp>

namespace fovea::apps {
namespace {

struct World {
    struct Job {
        std::string name;
    };
    struct Jobs {
        Job job{"cap"};
        const Job& operator[](int) const { return job; }
    };
    struct Camera {
        CameraTrouble now = CameraTrouble::none;
        CameraTrouble trouble() const { return now; }
    };

    std::int64_t now_us() const { return time_us; }
    const Jobs& jobs() const { return all; }
    Camera& camera() { return one; }
    const char* camera_fault() const { return "No such device"; }

    std::int64_t time_us = 5000000;
    Jobs all;
    Camera one;
};

struct Counting {
    const Tally& tally() const { return counts; }
    int job() const { return number; }

    Tally counts;
    int number = 1;
};

struct StatusLine : testing::Test {
    std::string turn() {
        const char* const got = line.turn(world, daemon);
        return got == nullptr ? "" : got;
    }

    World world;
    Counting daemon;
    apps::StatusLine line;
};

TEST_F(StatusLine, TellsTheJobAndItsCounts) {
    daemon.counts.count(Answer::ok);
    daemon.counts.count(Answer::not_ok);
    daemon.counts.count(Answer::not_ok);
    daemon.counts.count(Answer::missed);
    EXPECT_EQ(turn(), "cap: 1 OK, 2 NG, 0 ERROR, 1 missed");
    daemon.number = 0;
    world.time_us += 1000000;
    EXPECT_EQ(turn(), "no job: 1 OK, 2 NG, 0 ERROR, 1 missed");
}

TEST_F(StatusLine, ComesOnceASecondAndOnlyIfItIsAnother) {
    EXPECT_NE(turn(), "");
    EXPECT_EQ(turn(), "");
    daemon.counts.count(Answer::ok);
    world.time_us += 999999;
    EXPECT_EQ(turn(), "");
    world.time_us += 1;
    EXPECT_EQ(turn(), "cap: 1 OK, 0 NG, 0 ERROR, 0 missed");
    world.time_us += 60000000;
    EXPECT_EQ(turn(), "");
}

TEST_F(StatusLine, TellsWhatIsWrongWithTheCamera) {
    world.one.now = CameraTrouble::lost;
    EXPECT_EQ(turn(), "cap: 0 OK, 0 NG, 0 ERROR, 0 missed; camera_lost: No such device");
}

TEST_F(StatusLine, CutsWhatIsTooLong) {
    world.all.job.name = std::string(1000, 'x');
    EXPECT_EQ(turn(), std::string(299, 'x'));
}

}  // namespace
}  // namespace fovea::apps
