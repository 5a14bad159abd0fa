// SPDX-License-Identifier: MIT
//
// TestIo: what a command of the tool talks to, in memory: files, and everything it said. Host tests only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <fovea/linux/kernel.hpp>
#include <fovea/simulated/memory_storage.hpp>

#include <probe/machine.hpp>

namespace fovea::test {

/// Files in memory, the text of the standard output, and the lines of the standard error.
class TestIo {
public:
    using Storage = simulated::MemoryStorage;

    Storage& storage() { return files; }
    /// A machine without devices.
    linux_port::Kernel system() { return {}; }
    apps::MachineFolders machine() const {
        return {"/nowhere/sys", "/nowhere/dev", "/nowhere/proc", "/nowhere/group"};
    }
    void print(const std::string& text) { out += text; }
    void complain(const std::string& text) { complaints.push_back(text); }

    /// Writes a file as another program would have.
    void put(const std::string& name, const std::string& text) {
        files.files[name].assign(text.begin(), text.end());
    }
    void put(const std::string& name, const std::vector<std::uint8_t>& bytes) { files.files[name] = bytes; }
    bool has(const std::string& name) const { return files.files.count(name) != 0; }
    /// The bytes of a file as text; "" if there is none.
    std::string text(const std::string& name) const {
        const auto found = files.files.find(name);
        return found == files.files.end() ? "" : std::string(found->second.begin(), found->second.end());
    }
    /// All complaints, a line each.
    std::string errors() const {
        std::string all;
        for (const std::string& line : complaints) all += line + "\n";
        return all;
    }
    /// Forgets what was said, not the files.
    void hush() {
        out.clear();
        complaints.clear();
    }

    Storage files;
    std::string out;
    std::vector<std::string> complaints;
};

/// The lines of a text without their ends.
inline std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::size_t start = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', start)) {
        lines.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    if (start < text.size()) lines.push_back(text.substr(start));
    return lines;
}

}  // namespace fovea::test
