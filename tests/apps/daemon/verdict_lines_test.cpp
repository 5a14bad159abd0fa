// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>

#include <daemon/verdict_lines.hpp>

namespace fovea::apps {
namespace {

/// Six pins that write down every change, and see that no answer is ever wrong.
struct Wires {
    enum { ready, busy, valid, ok, not_ok, alarm, count };
    struct Pin {
        Wires* wires = nullptr;
        int number = 0;
        Status set(bool active) {
            if (wires->broken == number) return Status::io_error;
            wires->level[number] = active;
            wires->changes += std::string(1, "RBVONA"[number]) + (active ? "+" : "-") + " ";
            wires->look();
            return Status::ok;
        }
    };

    Wires() {
        for (int k = 0; k < count; ++k) pins[k] = {this, k};
    }
    VerdictLines<Pin>::Pins wired() {
        return {&pins[ready], &pins[busy], &pins[valid], &pins[ok], &pins[not_ok], &pins[alarm]};
    }
    /// What must hold between any two changes.
    void look() {
        EXPECT_FALSE(level[ok] && level[not_ok]) << changes;
        EXPECT_FALSE(level[valid] && level[ok] == level[not_ok]) << changes;
        EXPECT_FALSE(level[ready] && level[busy]) << changes;
    }
    std::string take() {
        std::string taken = changes;
        changes.clear();
        return taken;
    }

    Pin pins[count];
    bool level[count] = {};
    int broken = -1;
    std::string changes;
};

using Lines = VerdictLines<Wires::Pin>;

TEST(VerdictLines, BeginInTheSafeState) {
    Wires wires;
    for (bool& level : wires.level) level = false;
    Lines lines(wires.wired(), {});
    EXPECT_EQ(wires.take(), "V- O- N- B- R- A- ");
}

TEST(VerdictLines, FollowTheirDiagramWhereAnswersAreHeld) {
    Wires wires;
    Lines lines(wires.wired(), {});
    wires.take();
    lines.set_ready(true);
    lines.begin();
    EXPECT_EQ(wires.take(), "R+ R- B+ ");
    lines.set_ready(true);  // not while busy
    EXPECT_EQ(wires.take(), "");
    lines.show(Answer::ok, 0);
    lines.set_ready(true);
    EXPECT_EQ(wires.take(), "O+ V+ B- R+ ");
    EXPECT_EQ(lines.turn(1000000000), -1);
    lines.begin();
    EXPECT_EQ(wires.take(), "R- V- O- B+ ");
    lines.show(Answer::not_ok, 0);
    EXPECT_EQ(wires.take(), "N+ V+ B- ");
}

TEST(VerdictLines, EndAPulse) {
    Wires wires;
    Lines lines(wires.wired(), {LineMode::pulse, 50000, false});
    lines.begin();
    wires.take();
    lines.show(Answer::not_ok, 1000);
    EXPECT_EQ(wires.take(), "N+ V+ B- ");
    EXPECT_EQ(lines.turn(50999), 51000);
    EXPECT_EQ(wires.take(), "");
    EXPECT_EQ(lines.turn(51000), -1);
    EXPECT_EQ(wires.take(), "V- N- ");
    EXPECT_EQ(lines.turn(60000), -1);
}

TEST(VerdictLines, ShowNoAnswerForAnError) {
    Wires wires;
    Lines lines(wires.wired(), {});
    lines.begin();
    lines.show(Answer::ok, 0);
    lines.begin();
    wires.take();
    lines.show(Answer::error, 0);
    EXPECT_EQ(wires.take(), "B- ");
    Lines rejecting(wires.wired(), {LineMode::hold, 0, true});
    rejecting.begin();
    wires.take();
    rejecting.show(Answer::error, 0);
    EXPECT_EQ(wires.take(), "N+ V+ B- ");
}

TEST(VerdictLines, NeverCallValidWhatAPinRefused) {
    for (const int pin : {Wires::ok, Wires::not_ok}) {
        Wires wires;
        Lines lines(wires.wired(), {});
        lines.begin();
        wires.broken = pin;
        lines.show(pin == Wires::ok ? Answer::ok : Answer::not_ok, 0);
        EXPECT_FALSE(wires.level[Wires::valid]);
        EXPECT_EQ(lines.take_fault(), Status::io_error);
        EXPECT_EQ(lines.take_fault(), Status::ok);
        wires.broken = -1;
        lines.begin();
        lines.show(Answer::ok, 0);
        EXPECT_TRUE(wires.level[Wires::valid] && wires.level[Wires::ok]);
    }
}

TEST(VerdictLines, NeverCallValidBesideALineThatStaysActive) {
    Wires wires;
    Lines lines(wires.wired(), {});
    lines.begin();
    lines.show(Answer::ok, 0);
    wires.broken = Wires::ok;  // stays as it is
    lines.begin();
    lines.show(Answer::error, 0);
    EXPECT_FALSE(wires.level[Wires::valid]);
    lines.begin();
    lines.show(Answer::ok, 0);
    EXPECT_FALSE(wires.level[Wires::valid]);
}

TEST(VerdictLines, WorkWithoutPins) {
    Lines lines({}, {});
    lines.begin();
    lines.show(Answer::ok, 0);
    EXPECT_TRUE(lines.valid());
    lines.make_safe();
    EXPECT_FALSE(lines.valid());
    EXPECT_EQ(lines.take_fault(), Status::ok);
}

TEST(VerdictLines, AreNeverWrongWhateverComes) {
    Random random(7);
    for (int run = 0; run < 50; ++run) {
        Wires wires;
        Lines lines(wires.wired(), {run % 2 == 0 ? LineMode::hold : LineMode::pulse, 30, run % 3 == 0});
        std::int64_t now = 0;
        for (int k = 0; k < 400; ++k) {
            now += random.below(20);
            switch (random.below(6)) {
                case 0: lines.set_ready(random.below(2) == 0); break;
                case 1: lines.begin(); break;
                case 2: lines.show(static_cast<Answer>(random.below(4)), now); break;
                case 3: lines.turn(now); break;
                case 4: lines.set_alarm(random.below(2) == 0); break;
                case 5: lines.make_safe(); break;
            }
            wires.look();
        }
        lines.make_safe();
        for (const bool level : wires.level) EXPECT_FALSE(level);
    }
}

TEST(Tally, AddsUp) {
    Tally tally;
    EXPECT_TRUE(tally.adds_up());
    tally.count(Answer::ok);
    tally.took(300);
    tally.count(Answer::not_ok);
    tally.took(100);
    tally.count(Answer::error);
    tally.count(Answer::missed);
    EXPECT_TRUE(tally.adds_up());
    EXPECT_EQ(tally.triggers, 4u);
    EXPECT_EQ(tally.judged(), 2u);
    EXPECT_EQ(tally.shortest_us, 100);
    EXPECT_EQ(tally.longest_us, 300);
    EXPECT_EQ(tally.average_us(), 200);
    ++tally.triggers;
    EXPECT_FALSE(tally.adds_up());
}

}  // namespace
}  // namespace fovea::apps
