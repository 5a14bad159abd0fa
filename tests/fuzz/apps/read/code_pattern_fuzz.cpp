// SPDX-License-Identifier: MIT
//
// Any pattern and any text of a code, divided by the first line feed: the pattern is refused with a line of
// text, or answers. What is told of the text on a line is read back as it was.
#include <cstddef>
#include <cstdint>
#include <string>

#include <common/text.hpp>
#include <daemon/template_codes.hpp>
#include <read/code_rule.hpp>

namespace {

void require(bool claim) {
    if (!claim) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace fovea::apps;
    const std::string all(reinterpret_cast<const char*>(data), size);
    const std::size_t end = all.find('\n');
    const std::string pattern = all.substr(0, end);
    const std::string text = end == std::string::npos ? "" : all.substr(end + 1);
    CodePattern made;
    if (const std::string problem = made.read(pattern); problem.empty())
        static_cast<void>(made.fits(span_of(text)));
    else
        require(printable(problem));
    TemplateMarks marks;
    for (const char letter : pattern) marks.add(letter);
    std::string line;
    put_code_text(span_of(text), marks, [&](char letter) { line += letter; });
    require(printable(line));
    for (const char letter : line) require(letter == '\\' || !marks.contains(letter));
    std::string back;
    require(read_code_text(line, back).empty() && back == text);
    return 0;
}
