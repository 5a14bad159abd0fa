// SPDX-License-Identifier: MIT
//
// Proof: what a program on the emulated board saw, a line each: "ok", "FAILED" or "figure".
#pragma once

#include <dirent.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <fovea/base/status.hpp>

namespace fovea::board {

/// The middle of values; 0 of none.
inline std::int64_t median(std::vector<std::int64_t> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0 : values[values.size() / 2];
}

class Proof {
public:
    /// One thing that holds or does not; what says it as a sentence, detail what was seen instead.
    bool check(bool holds, const std::string& what, const std::string& detail = "") {
        std::printf("%s %s%s%s\n", holds ? "ok" : "FAILED", what.c_str(), holds || detail.empty() ? "" : ": ",
                    holds ? "" : detail.c_str());
        std::fflush(stdout);
        if (!holds) ++failures_;
        ++checks_;
        return holds;
    }
    template <class Value, class Wanted>
    bool equal(const Value& value, const Wanted& wanted, const std::string& what) {
        std::ostringstream seen;
        seen << value << ", not " << wanted;
        return check(value == wanted, what, seen.str());
    }
    bool status(Status seen, Status wanted, const std::string& what) {
        return check(seen == wanted, what, describe(seen));
    }
    template <class Value, class Limit>
    bool at_most(const Value& value, const Limit& limit, const std::string& what) {
        std::ostringstream seen;
        seen << value << ", more than " << limit;
        return check(value <= limit, what, seen.str());
    }
    /// A number that was measured, for the pages of docs.
    void figure(const std::string& name, std::int64_t value, const char* unit) {
        std::printf("figure %s = %lld %s\n", name.c_str(), static_cast<long long>(value), unit);
        std::fflush(stdout);
    }
    /// Median, 99th percentile and largest of times.
    void spread(const std::string& name, std::vector<std::int64_t> times_us) {
        std::sort(times_us.begin(), times_us.end());
        const std::size_t count = times_us.size();
        if (!check(count > 0, name + " was measured")) return;
        figure(name + ", median of " + std::to_string(count), times_us[count / 2], "us");
        figure(name + ", 99 of 100", times_us[(count - 1) * 99 / 100], "us");
        figure(name + ", the most", times_us.back(), "us");
    }
    /// For main(): a program that checked nothing has failed.
    int end() const {
        std::printf("%d checks, %d failed\n", checks_, failures_);
        return failures_ == 0 && checks_ > 0 ? 0 : 1;
    }

private:
    int checks_ = 0;
    int failures_ = 0;
};

/// What a process holds of the system.
struct Holdings {
    int files = 0;
    int mappings = 0;
    /// Of its own, in memory.
    std::int64_t resident_kib = 0;
};

inline Holdings holdings() {
    Holdings held;
    if (DIR* const folder = ::opendir("/proc/self/fd")) {
        while (::readdir(folder) != nullptr) ++held.files;
        ::closedir(folder);
    }
    std::ifstream maps("/proc/self/maps");
    for (std::string line; std::getline(maps, line);) ++held.mappings;
    std::ifstream status("/proc/self/statm");
    std::int64_t all = 0;
    std::int64_t resident = 0;
    status >> all >> resident;
    held.resident_kib = resident * 4;
    return held;
}

}  // namespace fovea::board
