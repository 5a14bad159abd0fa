// SPDX-License-Identifier: MIT
//
// fovea: the command-line tool. Wires the commands to the Linux port; what they do stands in their headers.
#include <cstdio>
#include <string>
#include <vector>

#include <fovea/linux/file_storage.hpp>
#include <fovea/linux/kernel.hpp>

#include <tool/commands.hpp>

namespace {

/// Files and devices of the system, standard output and standard error.
class LinuxIo {
public:
    using Storage = fovea::linux_port::FileStorage<>;

    Storage& storage() { return storage_; }
    fovea::linux_port::Kernel system() { return {}; }
    fovea::apps::MachineFolders machine() const { return {}; }
    void print(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) failed_ = true;
    }
    void complain(const std::string& text) {
        std::fflush(stdout);
        std::fprintf(stderr, "%s\n", text.c_str());
    }
    /// False if something printed did not arrive.
    bool flush() { return std::fflush(stdout) == 0 && !failed_; }

private:
    Storage storage_;
    bool failed_ = false;
};

}  // namespace

int main(int count, char** words) {
    LinuxIo io;
    const std::vector<std::string> arguments(words + (count > 0 ? 1 : 0), words + count);
    const fovea::apps::ExitCode code = fovea::apps::run_command(io, arguments);
    if (!io.flush()) {
        std::fprintf(stderr, "fovea: the standard output cannot be written\n");
        return fovea::apps::exit_failed;
    }
    return code;
}
