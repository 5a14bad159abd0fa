// SPDX-License-Identifier: MIT
//
// CheckList: what the doctor has looked at, a line for a person or for a program each.
#pragma once

#include <string>

#include <common/io.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Says each finding as soon as it is there, for some take a while. Say takes one text.
class CheckList {
public:
    using Say = void (*)(void* to, const std::string& text);

    CheckList(void* to, Say say, bool json) : to_(to), say_(say), json_(json) {}

    /// figures: further pairs of JSON, each with a comma in front.
    void ok(const char* check, const std::string& what, const std::string& figures = "") {
        tell("ok", check, what, "", figures);
    }
    void warn(const char* check, const std::string& what, const std::string& next,
              const std::string& figures = "") {
        ++warnings_;
        tell("warn", check, what, next, figures);
    }
    void fail(const char* check, const std::string& what, const std::string& next) {
        ++failures_;
        tell("FAIL", check, what, next, "");
    }

    int failures() const { return failures_; }
    int warnings() const { return warnings_; }

private:
    void tell(const std::string& verdict, const std::string& check, const std::string& what,
              const std::string& next, const std::string& figures) {
        if (json_)
            return say_(to_, "{\"schema\":1,\"check\":\"" + check + "\",\"result\":\"" +
                                 small_letters(verdict) + "\",\"text\":" + json_string(what) +
                                 (next.empty() ? "" : ",\"try\":" + json_string(next)) + figures + "}\n");
        const auto padded = [](const std::string& word, std::size_t width) {
            return word + std::string(word.size() < width ? width - word.size() : 1, ' ');
        };
        say_(to_, padded(verdict, 6) + padded(check, 10) + one_line(what) + "\n" +
                      (next.empty() ? "" : std::string(16, ' ') + "try: " + one_line(next) + "\n"));
    }

    void* to_;
    Say say_;
    bool json_;
    int failures_ = 0;
    int warnings_ = 0;
};

}  // namespace fovea::apps
