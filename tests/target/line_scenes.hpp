// SPDX-License-Identifier: MIT
//
// Scenes of 640x480 that are computed line by line, with noise of up to 31 grey levels.
#pragma once

#include <cstdint>

#include <fovea/base/random.hpp>
#include <fovea/image/geometry.hpp>
#include <fovea/image/pixel.hpp>

namespace fovea::target {

/// A dark plate with a round hole on a bright ground, with noise; turned by the number of its frame.
class PlateScene {
public:
    static constexpr Size size{640, 480};
    static constexpr int frames = 3;

    explicit PlateScene(int frame)
        : run_(12 - 2 * frame), rise_(5 + 3 * frame), random_(static_cast<unsigned>(40 + frame)) {}

    /// The next line, from the top.
    void take(Gray8* line) {
        const int dy = y_ - 230;
        for (int x = 0; x < size.width; ++x) {
            const int dx = x - 310;
            const int along = run_ * dx + rise_ * dy;
            const int across = run_ * dy - rise_ * dx;
            const bool plate = along > -2200 && along < 2200 && across > -1100 && across < 1100;
            const bool hole = dx * dx + dy * dy < 35 * 35;
            const int noise = static_cast<int>(random_.next() >> 27);
            line[x] = static_cast<Gray8>((plate && !hole ? 40 : 190) + noise);
        }
        ++y_;
    }

private:
    int run_;
    int rise_;
    Random random_;
    int y_ = 0;
};

/// A dark cord on a bright ground, which gets thinner and thicker, and specks of dirt.
class CordScene {
public:
    static constexpr Size size{640, 480};
    static constexpr int frames = 2;

    explicit CordScene(int frame) : frame_(frame), random_(static_cast<unsigned>(50 + frame)) {}

    void take(Gray8* line) {
        // Up and down within 128 rows.
        const int wave = y_ % 128 < 64 ? y_ % 128 : 128 - y_ % 128;
        const int first = 200 + 60 * frame_ + wave / 2;
        const int end = first + 70 - wave / 4 + 10 * frame_;
        const bool cord = y_ >= 25 + 30 * frame_ && y_ < 461;
        for (int x = 0; x < size.width; ++x) {
            const bool dirt = (x / 9 + y_ / 5 * 7) % 61 == 0;
            const int noise = static_cast<int>(random_.next() >> 27);
            line[x] = static_cast<Gray8>(((cord && x >= first && x < end) || dirt ? 35 : 180) + noise);
        }
        ++y_;
    }

private:
    int frame_;
    Random random_;
    int y_ = 0;
};

/// A laser line that runs aslant, over a step, and is hidden for some rows; beside it a weak reflection.
class LaserScene {
public:
    static constexpr Size size{640, 480};
    static constexpr int frames = 2;

    explicit LaserScene(int frame) : frame_(frame), random_(static_cast<unsigned>(60 + frame)) {}

    void take(Gray8* line) {
        // In 1/16 px.
        const int slope = y_ * (3 + 2 * frame_);
        const int step = y_ >= 200 && y_ < 320 ? 16 * 24 + 5 : 0;
        const int centre = 16 * 180 + slope + step;
        const bool hidden = y_ >= 320 && y_ < 335;
        for (int x = 0; x < size.width; ++x) {
            const int from_line = 16 * x - centre;
            const int from_reflection = 16 * x - centre - 16 * 90;
            int light = hidden ? 0 : bump(from_line, 190);
            if (y_ >= 100 && y_ < 140) light += bump(from_reflection, 90);
            line[x] = static_cast<Gray8>(12 + light + static_cast<int>(random_.next() >> 28));
        }
        ++y_;
    }

private:
    /// A parabola six pixels wide.
    static int bump(int distance, int height) {
        return distance <= -48 || distance >= 48 ? 0 : height - height * distance * distance / (48 * 48);
    }

    int frame_;
    Random random_;
    int y_ = 0;
};

/// A yard with a pattern; a lamp is switched on, and then someone walks through.
class YardScene {
public:
    static constexpr Size size{640, 480};
    static constexpr int frames = 5;

    explicit YardScene(int frame) : frame_(frame), random_(static_cast<unsigned>(70 + frame)) {}

    void take(Gray8* line) {
        const int lamp = frame_ >= 2 ? 45 : 0;
        const int left = 60 + 110 * frame_;
        const bool walker = frame_ >= 3 && y_ >= 150 && y_ < 290;
        for (int x = 0; x < size.width; ++x) {
            const int ground = 40 + (x / 20 + y_ / 30) % 5 * 20;
            const int noise = static_cast<int>(random_.next() >> 27);
            line[x] =
                static_cast<Gray8>((walker && x >= left && x < left + 48 ? 215 : ground + lamp) + noise);
        }
        ++y_;
    }

private:
    int frame_;
    Random random_;
    int y_ = 0;
};

}  // namespace fovea::target
