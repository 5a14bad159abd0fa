// SPDX-License-Identifier: MIT
//
// Any template for results: it is refused with a place, or fills in without leaving its room.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <fovea/base/span.hpp>

#include <daemon/inspection.hpp>
#include <daemon/result_template.hpp>
#include <daemon/tally.hpp>
#include <daemon/text_buffer.hpp>

using namespace fovea;
using namespace fovea::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Span<const char> text(reinterpret_cast<const char*>(data), static_cast<std::ptrdiff_t>(size));
    ResultTemplate made;
    if (made.read(text) != Status::ok) {
        if (made.problem()[0] == '\0' || made.place() < 1 || made.place() > static_cast<int>(size) + 1)
            std::abort();
        return 0;
    }
    Inspection inspection;
    inspection.number = ~std::uint64_t{0} >> 1;
    inspection.job = letters_of("job");
    inspection.values = 2;
    inspection.value[0] = {letters_of("d1"), Status::ok, Verdict::high, {-32114499}, 3};
    inspection.value[1] = {letters_of("f"), Status::not_found, Verdict::unmeasured, {}, 3};
    // The template itself is what stands in a code.
    CodeReading readings[2];
    readings[0].text = text.first(size < 40 ? text.size() : 40);
    readings[0].bytes = {data, static_cast<std::ptrdiff_t>(size < 40 ? size : 40)};
    inspection.codes = readings;
    char room[200];
    TextBuffer line(room);
    made.write(inspection, Tally(), line);
    if (line.size() > 200) std::abort();
    return 0;
}
