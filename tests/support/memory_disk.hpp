// SPDX-License-Identifier: MIT
//
// MemoryDisk: one folder of a disk whose power can be cut, and the calls of the Linux ports into it. Host
// tests only.
#pragma once

#include <fcntl.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>

namespace fovea::test {

/// What a power cut may do with the names that a folder was not synced with.
enum class Journal : std::uint8_t {
    kept,  ///< the changes up to one of them have happened, none after it
    none,  ///< each has happened or not, by half (a name is gone, and the other not there yet), in any combination
};

/// Files are as durable as they were synced. What was not synced may be there after a cut, or not, or in part
/// with zeros or noise behind it.
class MemoryDisk {
public:
    using Bytes = std::vector<std::uint8_t>;

    Journal journal = Journal::kept;
    /// As a disk that lies: nothing is durable before its time.
    bool ignores_syncs = false;
    /// The call after which there is no power any more, counted from 1; 0 for none.
    int cut_at = 0;
    int calls = 0;
    int open_files() const { return static_cast<int>(opened_.size()); }

    /// What a program that starts anew finds.
    void power_on(Random& random) {
        Names names = durable_names_;
        std::size_t count = random.below(static_cast<std::uint32_t>(changes_.size()) + 1);
        if (journal == Journal::none) count = changes_.size();
        for (std::size_t i = 0; i < count; ++i) apply(changes_[i], names, random);
        for (auto& [name, file] : names) {
            if (file->durable == file->now) continue;
            const Bytes written = file->now;
            switch (random.below(4)) {
                case 0: file->now = file->durable; break;
                case 1: break;
                default: {
                    const std::size_t good = random.below(static_cast<std::uint32_t>(written.size()) + 1);
                    file->now.resize(good);
                    const std::uint8_t mask = random.below(2) == 0 ? 0 : 255;
                    if (random.below(2) == 0)
                        while (file->now.size() < written.size())
                            file->now.push_back(static_cast<std::uint8_t>(random.next() >> 24) & mask);
                }
            }
            file->durable = file->now;
        }
        names_ = durable_names_ = names;
        changes_.clear();
        opened_.clear();
        cut_at = calls = 0;
    }
    void put(const std::string& name, const Bytes& bytes) {
        names_[name] = durable_names_[name] = std::make_shared<File>(File{bytes, bytes});
    }
    const Bytes* content(const std::string& name) const {
        const auto found = names_.find(name);
        return found == names_.end() ? nullptr : &found->second->now;
    }

    int open(const std::string& name, int flags) {
        if (!power()) return -EIO;
        if ((flags & O_DIRECTORY) != 0) return number_of(nullptr);
        auto found = names_.find(name);
        if (found == names_.end()) {
            if ((flags & O_CREAT) == 0) return -ENOENT;
            found = names_.emplace(name, std::make_shared<File>()).first;
            changes_.push_back({"", name, found->second});
        } else if ((flags & O_TRUNC) != 0) {
            found->second->now.clear();
        }
        return number_of(found->second);
    }
    int close(int number) {
        opened_.erase(number);
        return power() ? 0 : -EIO;
    }
    std::ptrdiff_t read(int number, Span<std::uint8_t> into) {
        if (!power()) return -EIO;
        Open& open = opened_.at(number);
        const std::size_t left = open.file->now.size() - open.at;
        const std::size_t count = std::min(left, static_cast<std::size_t>(into.size()));
        std::copy_n(open.file->now.begin() + static_cast<std::ptrdiff_t>(open.at), count, into.begin());
        open.at += count;
        return static_cast<std::ptrdiff_t>(count);
    }
    std::ptrdiff_t write(int number, Span<const std::uint8_t> bytes) {
        Bytes& now = opened_.at(number).file->now;
        now.insert(now.end(), bytes.begin(), bytes.end());
        return power() ? bytes.size() : -EIO;
    }
    int sync(int number) {
        if (!power()) return -EIO;
        if (ignores_syncs) return 0;
        if (const auto& file = opened_.at(number).file) {
            file->durable = file->now;
        } else {
            durable_names_ = names_;
            changes_.clear();
        }
        return 0;
    }
    int rename(const std::string& from, const std::string& to) {
        // The last call may happen or not: power_on() says which.
        const bool on = power();
        if (on || calls == cut_at) {
            changes_.push_back({from, to, names_.at(from)});
            names_[to] = names_.at(from);
            names_.erase(from);
        }
        return on ? 0 : -EIO;
    }
    int remove(const std::string& name) {
        if (!power()) return -EIO;
        changes_.push_back({name, "", nullptr});
        return names_.erase(name) == 1 ? 0 : -ENOENT;
    }

private:
    struct File {
        Bytes now, durable;
    };
    using Names = std::map<std::string, std::shared_ptr<File>>;
    struct Open {
        std::shared_ptr<File> file;
        std::size_t at = 0;
    };
    /// A file gets a name, another or none.
    struct Change {
        std::string from, to;
        std::shared_ptr<File> file;
    };

    bool power() { return ++calls < cut_at || cut_at == 0; }
    int number_of(std::shared_ptr<File> file) {
        opened_[++last_number_] = {std::move(file)};
        return last_number_;
    }
    void apply(const Change& change, Names& names, Random& random) const {
        const bool all = journal == Journal::kept;
        if (!change.from.empty() && (all || random.below(3) != 0)) names.erase(change.from);
        if (!change.to.empty()) {
            if (all || random.below(3) != 0)
                names[change.to] = change.file;
            else if (random.below(3) == 0)
                names.erase(change.to);
        }
    }

    Names names_, durable_names_;
    std::vector<Change> changes_;
    std::map<int, Open> opened_;
    int last_number_ = 2;
};

/// The disk as a system of the Linux ports; lives longer than the handles to it.
struct DiskSystem {
    MemoryDisk* disk = nullptr;

    int open(const char* path, int flags, unsigned = 0) { return disk->open(path, flags); }
    int close(int file) { return disk->close(file); }
    std::ptrdiff_t read(int file, Span<std::uint8_t> into) { return disk->read(file, into); }
    std::ptrdiff_t write(int file, Span<const std::uint8_t> bytes) { return disk->write(file, bytes); }
    int sync(int file) { return disk->sync(file); }
    int rename(const char* from, const char* to) { return disk->rename(from, to); }
    int remove(const char* path) { return disk->remove(path); }
    std::int64_t monotonic_us() { return 0; }
    int process_id() { return 1; }
};

}  // namespace fovea::test
