// SPDX-License-Identifier: MIT
//
// Any runs along a line, in every symbology: what is read has its digits, its check and its place; and what
// is encoded of any bytes is read again.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/code/bar_edges.hpp>
#include <fovea/code/code_128_encoder.hpp>
#include <fovea/code/decode_bars.hpp>
#include <fovea/code/two_width_encoder.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

BarRules rules_from(std::uint8_t bits) {
    BarRules rules;
    rules.add_on = (bits & 1) != 0 ? AddOn::appended : AddOn::ignored;
    rules.code_39_text = (bits & 2) != 0 ? Code39Text::full_ascii : Code39Text::plain;
    const CheckCharacter check = static_cast<CheckCharacter>((bits >> 2) % 3);
    rules.code_39_check = rules.interleaved_check = rules.codabar_check = check;
    rules.interleaved_shortest = 2 + (bits >> 5) * 2;
    return rules;
}

void check(BarEdges edges, const BarRules& rules) {
    BarReading reading;
    for (int first = 0; decode_bars(edges, first, rules, reading) == Status::ok; first = reading.last) {
        require(reading.first >= first && reading.last > reading.first && reading.last < edges.size());
        require(reading.size > 0 && reading.size <= most_bar_text && reading.base <= reading.size);
        require(reading.error >= 0 && reading.quiet > 0 && reading.quiet <= 256);
        require(rules.symbologies.contains(reading.symbology));
    }
}

/// The edges of bars that were drawn, with quiet zones of twelve modules.
std::vector<std::int32_t> edges_of(Span<const std::uint8_t> widths) {
    std::vector<std::int32_t> edges = {0, 12 * 512};
    for (const std::uint8_t width : widths) edges.push_back(edges.back() + width * 512);
    edges.push_back(edges.back() + 12 * 512);
    return edges;
}

void check_round_trip(Span<const std::uint8_t> text) {
    std::vector<std::uint8_t> room(3000);
    int count = 0;
    const BarWidths widths(room.data(), 3000, &count);
    if (encode_code_128(text, Code128Kind::plain, widths) != Status::ok) return;
    const std::vector<std::int32_t> edges = edges_of({room.data(), count});
    BarReading reading;
    require(decode_code_128({edges.data(), static_cast<std::ptrdiff_t>(edges.size())}, 1, reading) ==
            Status::ok);
    require(reading.size == text.size());
    for (int i = 0; i < reading.size; ++i) require(reading.text[i] == text[i]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 3) return 0;
    const BarRules rules = rules_from(data[0]);
    const int scale = 1 << data[1] % 20;
    std::vector<std::int32_t> edges = {(data[1] & 128) != 0 ? -(1 << 30) : 0};
    for (std::size_t i = 2; i < size && edges.size() < 700; ++i) {
        const std::int64_t next = std::int64_t{edges.back()} + std::int64_t{data[i]} * scale;
        if (next > 0x7fffffff) break;
        edges.push_back(static_cast<std::int32_t>(next));
    }
    const BarEdges line(edges.data(), static_cast<std::ptrdiff_t>(edges.size()));
    check(line, rules);
    if ((data[1] & 128) == 0) {
        std::vector<std::int32_t> reversed(edges.size() + 1);
        const int count =
            reverse_bar_edges(line, {reversed.data(), static_cast<std::ptrdiff_t>(reversed.size())});
        check({reversed.data(), count}, rules);
    }
    check_round_trip({data + 2, static_cast<std::ptrdiff_t>(size - 2)});
    return 0;
}
