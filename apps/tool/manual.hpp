// SPDX-License-Identifier: MIT
//
// The manual page fovea(1), made of what the commands say of themselves. apps/tool/fovea.1 is its print.
#pragma once

#include <string>
#include <vector>

#include <common/arguments.hpp>

namespace fovea::apps {

/// A text as lines of a manual page: nothing in it is a command of roff.
inline std::string manual_text(const std::string& text) {
    std::string page;
    for (const char c : text) {
        // A point or a quote would begin a command at the start of a line.
        if ((c == '.' || c == '\'') && (page.empty() || page.back() == '\n')) page += "\\&";
        if (c == '-')
            page += "\\-";
        else if (c == '\\')
            page += "\\e";
        else
            page += c;
    }
    return page;
}

/// The page of a tool with these commands.
inline std::string manual_page(const std::vector<Command>& commands) {
    std::string page =
        ".\\\" SPDX-License-Identifier: MIT\n"
        ".TH FOVEA 1 \"\" \"fovea\" \"fovea\"\n.SH NAME\nfovea \\- measures and decides with pictures\n"
        ".SH SYNOPSIS\n.B fovea\n.I COMMAND\n.RI [ options ]\n.RI [ words ]\n.SH COMMANDS\n";
    for (const Command& command : commands) {
        page += ".SS fovea " + manual_text(command.name);
        page += std::string(command.operands[0] != '\0' ? " " : "") + manual_text(command.operands) + "\n";
        page += manual_text(command.summary) + "\n";
        for (const Option& option : command.options) {
            page += ".TP\n.B \\-\\-" + manual_text(option.name);
            page += std::string(option.value[0] != '\0' ? " " : "") + manual_text(option.value) + "\n";
            page += manual_text(option.text) + "\n";
        }
        // Their lines are set as they are: there are tables among them.
        if (command.notes[0] != '\0') page += ".PP\n.nf\n" + manual_text(command.notes) + ".fi\n";
    }
    return page +
           ".SH \"EXIT STATUS\"\n.TP\n.B 0\nAll is well.\n.TP\n.B 1\nJudged, and something is not as it "
           "should "
           "be.\n.TP\n.B 2\nIt could not judge, or was used wrongly.\n.SH \"SEE ALSO\"\n.BR fovead (8),\n"
           ".BR fovead.conf (5)\n";
}

}  // namespace fovea::apps
