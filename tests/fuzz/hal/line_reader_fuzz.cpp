// SPDX-License-Identifier: MIT
//
// Any bytes in any pieces as lines: none is too long or has a control byte, each error is told once a line,
// and no bytes are lost or found twice.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fovea/hal/line_reader.hpp>
#include <fovea/simulated/byte_pipe.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

/// What the reader must say of a text: its lines, and "" for one that is refused.
std::vector<std::string> expected(const std::string& text, std::size_t most) {
    std::vector<std::string> all;
    std::string line;
    bool bad = false;
    for (const char byte : text) {
        const unsigned char code = static_cast<unsigned char>(byte);
        if (byte == '\r' || byte == '\n') {
            if (!bad && !line.empty()) all.push_back(line);
            line.clear();
            bad = false;
        } else if (!bad) {
            line += byte;
            bad = code < 32 || code == 127 || line.size() > most;
            if (bad) all.emplace_back();
        }
    }
    return all;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    // The first byte says in which pieces the others arrive.
    const std::size_t piece = 1 + data[0] % 64;
    const std::string text(data + 1, data + size);
    hal::LineReader<20, 32> reader;
    simulated::BytePipe pipe;
    std::vector<std::string> said;
    std::uint32_t refused = 0;
    for (std::size_t at = 0; at < text.size() || !pipe.arriving.empty();) {
        const std::size_t count = std::min(piece, text.size() - at);
        pipe.arriving.insert(pipe.arriving.end(), data + 1 + at, data + 1 + at + count);
        at += count;
        const std::size_t before = pipe.arriving.size();
        require(reader.fill(pipe) == Status::ok);
        require(before - pipe.arriving.size() == std::min<std::size_t>(before, 32));
        for (;;) {
            const Result<Span<const char>> line = reader.next();
            if (line && line->empty()) break;
            said.emplace_back(line ? std::string(line->begin(), line->end()) : std::string());
            refused += !line;
        }
    }
    require(said == expected(text, 20));
    require(refused == reader.refused());
    return 0;
}
