// SPDX-License-Identifier: MIT
//
// MemoryStorage: hal storage in memory, for tests of the applications.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/storage.hpp>

namespace fovea::simulated {

/// Byte strings in a map. Names in `refused` answer io_error, as a broken medium would.
class MemoryStorage {
public:
    Result<Span<const std::uint8_t>> load(const char* name) {
        if (refused == name) return Status::io_error;
        const auto found = files.find(name);
        if (found == files.end()) return Status::not_found;
        loaded_ = found->second;
        return Span<const std::uint8_t>(loaded_.data(), static_cast<std::ptrdiff_t>(loaded_.size()));
    }
    Status save(const char* name, Span<const std::uint8_t> bytes) {
        if (refused == name) return Status::io_error;
        files[name].assign(bytes.begin(), bytes.end());
        return Status::ok;
    }
    const char* problem() const { return "simulated fault"; }

    std::map<std::string, std::vector<std::uint8_t>> files;
    std::string refused;

private:
    std::vector<std::uint8_t> loaded_;
};

static_assert(hal::is_storage_v<MemoryStorage>);

}  // namespace fovea::simulated
