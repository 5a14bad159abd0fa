// SPDX-License-Identifier: MIT
//
// Saves without end, telling each number once it is saved, until the power is cut; and looks at what is left.
//   storage_on_board seed FOLDER KIND...    saves one of each KIND: file, generations, in_place
//   storage_on_board save FOLDER KIND...    and without end
//   storage_on_board read FOLDER KIND...    prints the number that each holds, or what is wrong
// in_place is no storage of fovea: it truncates and writes, as many programs save their settings.
#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <fovea/linux/file_storage.hpp>
#include <fovea/linux/generations.hpp>

namespace {

using namespace fovea;

using Bytes = std::vector<std::uint8_t>;

/// A number and bytes that only it has, of some length between 4 and 20000 (xorshift32).
Bytes content(std::uint32_t number) {
    Bytes bytes(4 + number * 7919 % 20000);
    for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(number >> 8 * i);
    std::uint32_t x = number * 2654435761u | 1u;
    for (std::size_t i = 4; i < bytes.size(); ++i) {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        bytes[i] = static_cast<std::uint8_t>(x);
    }
    return bytes;
}

class Store {
public:
    Store(const std::string& folder, std::string kind)
        : kind_(std::move(kind)), path_(folder + "/" + kind_), memory_(32768) {}

    bool save(std::uint32_t number) {
        const Bytes bytes = content(number);
        const Span<const std::uint8_t> span(bytes.data(), static_cast<std::ptrdiff_t>(bytes.size()));
        if (kind_ == "file") return files_.save(path_.c_str(), span) == Status::ok;
        if (kind_ == "generations") return generations_.save(path_.c_str(), span) == Status::ok;
        const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        const ssize_t wrote = ::write(file, bytes.data(), bytes.size());
        return ::close(file) == 0 && wrote == static_cast<ssize_t>(bytes.size());
    }

    /// The number that it holds; -1 and a line otherwise.
    long read() {
        const auto got =
            kind_ == "generations" ? generations_.load(path_.c_str()) : files_.load(path_.c_str());
        if (!got) return complain(describe(got.status()));
        const Span<const std::uint8_t> bytes = *got;
        if (bytes.size() < 4) return complain(bytes.empty() ? "empty" : "cut short");
        std::uint32_t number = 0;
        for (int i = 3; i >= 0; --i) number = number << 8 | bytes[i];
        const Bytes wanted = content(number);
        if (Bytes(bytes.begin(), bytes.end()) != wanted) return complain("torn");
        return static_cast<long>(number);
    }

    const std::string& kind() const { return kind_; }

private:
    long complain(const char* what) {
        std::printf("%s: %s\n", kind_.c_str(), what);
        return -1;
    }

    std::string kind_;
    std::string path_;
    Bytes memory_;
    linux_port::FileStorage<> files_;
    linux_port::GenerationStorage<> generations_{
        linux_port::Kernel(), {memory_.data(), static_cast<std::ptrdiff_t>(memory_.size())}};
};

/// At most so many, for a run that nobody ends. What a line of the standard output says has left the board.
int save_without_end(std::vector<Store>& stores, std::uint32_t most) {
    for (std::uint32_t number = 1; number <= most; ++number)
        for (Store& store : stores) {
            if (!store.save(number)) {
                std::printf("%s: not saved\n", store.kind().c_str());
                return 1;
            }
            std::printf("%s %u\n", store.kind().c_str(), number);
        }
    return 0;
}

}  // namespace

int main(int count, char** words) {
    const std::string what = count > 3 ? words[1] : "";
    if (what != "save" && what != "read" && what != "seed") {
        std::fprintf(stderr, "usage: storage_on_board seed|save|read FOLDER file|generations|in_place...\n");
        return 2;
    }
    std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);
    std::vector<Store> stores;
    stores.reserve(3);
    for (int k = 3; k < count; ++k) stores.emplace_back(words[2], words[k]);
    if (what != "read") return save_without_end(stores, what == "seed" ? 1 : 1000000);
    bool good = true;
    for (Store& store : stores) {
        const long number = store.read();
        good = good && number >= 0;
        if (number >= 0) std::printf("%s %ld\n", store.kind().c_str(), number);
    }
    return good ? 0 : 1;
}
