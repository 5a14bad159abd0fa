// SPDX-License-Identifier: MIT
//
// Any line on the serial port of the daemon: it is no command, or one whose words may become the name of a
// file.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <fovea/base/span.hpp>

#include <daemon/command.hpp>
#include <daemon/text_buffer.hpp>

using namespace fovea;
using namespace fovea::apps;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Span<const char> line(reinterpret_cast<const char*>(data), static_cast<std::ptrdiff_t>(size));
    const SerialCommand command = read_command(line);
    const Span<const char> parts[] = {command.id, command.name};
    for (const Span<const char> part : parts)
        if (!part.empty() && (part.begin() < line.begin() || part.end() > line.end())) std::abort();
    for (const char c : command.name)
        if (c == '/' || c < ' ' || c > '~') std::abort();
    if (!command.name.empty() && command.name[0] == '.') std::abort();
    const bool named = command.verb == CommandVerb::take_job || command.verb == CommandVerb::teach;
    if (command.error == CommandError::none && named == command.name.empty()) std::abort();
    char room[64];
    TextBuffer reply(room);
    if (command.error != CommandError::none) reply_error(command, command.error, reply);
    // What is echoed cannot end the line of a reply.
    for (const char c : reply.letters())
        if (c < ' ' || c > '~') std::abort();
    return 0;
}
