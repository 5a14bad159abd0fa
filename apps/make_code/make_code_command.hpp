// SPDX-License-Identifier: MIT
//
// fovea make-code: a text as a bar or matrix code, for labels and to try things on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <common/arguments.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>
#include <make_code/code_modules.hpp>
#include <read/symbology_names.hpp>

namespace fovea::apps {

inline Command make_code_help() {
    return {"make-code",
            "--out PICTURE TEXT",
            "Writes a text as a bar code, a QR code or a Data Matrix code.",
            {{"out", "PICTURE", "PNG, PGM or SVG to write; required"},
             {"symbology", "NAME", "such as `ean-13` or `data-matrix`; `qr` if not given"},
             {"module", "PX", "width of a module, 1 to 64; 4. In SVG a module is 1"},
             {"height", "MODULES", "of bars; 50"},
             {"quiet", "MODULES", "light margin on all sides; what the standard asks if not given"},
             {"level", "L|M|Q|H", "of QR: 7, 15, 25 or 30 % may be damaged; M"},
             {"size", "ROWSxCOLS", "of Data Matrix, such as 16x48; the smallest square if not given"},
             {"gs1", "", "Code 128 and Data Matrix: GS1 element strings, \\x1d between them"},
             {"ascii", "", "Code 39: all of ASCII"},
             {"check", "", "Code 39, Interleaved 2 of 5 and Codabar: adds a check character"},
             {"inverted", "", "light on dark"}},
            "Check digits of EAN and UPC are added where they are left out. \\n, \\t, \\\\ and \\xNN in TEXT "
            "stand\n"
            "for bytes. `fovea read PICTURE` reads what was written.\n"};
}

namespace detail {

/// "a\x1db" with its bytes; false where a backslash is followed by nothing that is known.
inline bool unescape(const std::string& text, std::string& bytes) {
    bytes.clear();
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\\') {
            bytes += text[i];
            continue;
        }
        const char kind = i + 1 < text.size() ? text[++i] : '\0';
        if (kind == 'n')
            bytes += '\n';
        else if (kind == 't')
            bytes += '\t';
        else if (kind == 'r')
            bytes += '\r';
        else if (kind == '\\')
            bytes += '\\';
        else if (kind == 'x' && i + 2 < text.size()) {
            int value = 0;
            for (int k = 0; k < 2; ++k) {
                const char c = small_letters(text.substr(++i, 1))[0];
                if ((c < '0' || c > '9') && (c < 'a' || c > 'f')) return false;
                value = value * 16 + (c <= '9' ? c - '0' : c - 'a' + 10);
            }
            bytes += static_cast<char>(value);
        } else {
            return false;
        }
    }
    return true;
}

inline std::string read_design(const Arguments& arguments, CodeDesign& design, int& module) {
    SymbologySet set;
    std::string problem = read_symbologies(arguments.value("symbology", "qr"), set);
    if (!problem.empty()) return problem;
    int count = 0;
    for (int i = 0; i < symbology_count; ++i) {
        if (!set.contains(symbology_at(i))) continue;
        design.symbology = symbology_at(i);
        ++count;
    }
    if (count != 1) return "--symbology takes one of them";
    if (!whole_option(arguments, "module", 1, 64, module, problem)) return problem;
    if (!whole_option(arguments, "height", 1, 1000, design.bar_height, problem)) return problem;
    if (!whole_option(arguments, "quiet", 0, 100, design.quiet, problem)) return problem;
    const std::string level = small_letters(arguments.value("level", "m"));
    const std::size_t at = std::string("lmqh").find(level);
    if (level.size() != 1 || at == std::string::npos)
        return "--level takes L, M, Q or H, not '" + one_line(arguments.value("level")) + "'";
    design.qr.level = static_cast<QrLevel>(at);
    if (arguments.has("size")) {
        const std::vector<std::string> sides = split(arguments.value("size"), 'x');
        int side[2] = {};
        bool right = sides.size() == 2;
        for (std::size_t i = 0; right && i < 2; ++i) {
            const Result<Decimal> number = parse_decimal(span_of(sides[i]));
            right = number && number->millionths % 1000000 == 0 && number->millionths > 0 &&
                    number->millionths <= 200000000;
            if (right) side[i] = static_cast<int>(number->millionths / 1000000);
        }
        if (!right)
            return "--size takes rows and columns such as 16x48, not '" + one_line(arguments.value("size")) +
                   "'";
        design.data_matrix.size = {side[1], side[0]};
        design.data_matrix.extended = true;
    }
    design.data_matrix.gs1 = arguments.has("gs1");
    if (arguments.has("gs1")) design.code_128 = Code128Kind::gs1;
    if (arguments.has("ascii")) design.code_39 = Code39Text::full_ascii;
    design.check = arguments.has("check");
    return "";
}

/// Modules as a picture; bars are drawn over their height.
inline Picture<Gray8> picture_of(const CodeModules& modules, int bar_height, int module, bool inverted) {
    const int rows = modules.bars ? bar_height : modules.size.height;
    Picture<Gray8> picture(
        {(modules.size.width + 2 * modules.quiet) * module, (rows + 2 * modules.quiet) * module});
    const auto dark = static_cast<Gray8>(inverted ? 255 : 0);
    const auto light = static_cast<Gray8>(inverted ? 0 : 255);
    for (int y = 0; y < picture.size.height; ++y)
        for (int x = 0; x < picture.size.width; ++x) {
            const int column = x / module - modules.quiet;
            const int row = y / module - modules.quiet;
            const bool inside = column >= 0 && column < modules.size.width && row >= 0 && row < rows;
            const int line = modules.bars ? 0 : row;
            picture.view()(x, y) = inside && modules.is_dark(column, line) ? dark : light;
        }
    return picture;
}

/// Modules as a drawing: a rectangle for each run of dark ones in a row.
inline std::string svg_of(const CodeModules& modules, int bar_height, bool inverted) {
    const int rows = modules.bars ? bar_height : modules.size.height;
    const std::string width = std::to_string(modules.size.width + 2 * modules.quiet);
    const std::string height = std::to_string(rows + 2 * modules.quiet);
    std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + width + " " + height +
                       "\" shape-rendering=\"crispEdges\">\n<path fill=\"" + (inverted ? "#000" : "#fff") +
                       "\" d=\"M0 0h" + width + "v" + height + "H0z\"/>\n<path fill=\"" +
                       (inverted ? "#fff" : "#000") + "\" d=\"";
    for (int y = 0; y < modules.size.height; ++y)
        for (int x = 0; x < modules.size.width;) {
            int end = x;
            while (end < modules.size.width && modules.is_dark(end, y)) ++end;
            if (end > x) {
                const std::string run = std::to_string(end - x);
                text += "M" + std::to_string(x + modules.quiet) + " " + std::to_string(y + modules.quiet) +
                        "h" + run + "v" + std::to_string(modules.bars ? bar_height : 1) + "h-" + run + "z";
            }
            x = end + 1;
        }
    return text + "\"/>\n</svg>\n";
}

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode make_code_command(Io& io, const std::vector<std::string>& words) {
    const Arguments arguments(make_code_help(), words);
    if (arguments.has("help")) {
        io.print(help_of(make_code_help()));
        return exit_ok;
    }
    std::string problem = arguments.problem();
    const std::string out = arguments.value("out");
    CodeDesign design;
    int module = 4;
    std::string text;
    if (problem.empty() && out.empty()) problem = "where to? give --out PICTURE";
    if (problem.empty() && arguments.operands().size() != 1)
        problem =
            arguments.operands().empty() ? "which text? give TEXT" : "one text at a time; put it in quotes";
    if (problem.empty()) problem = detail::read_design(arguments, design, module);
    if (problem.empty() && !detail::unescape(arguments.operands()[0], text))
        problem = "\\ in a text is followed by n, r, t, x and two hexadecimal digits, or \\";
    CodeModules modules;
    if (problem.empty()) problem = modules_of(text, design, modules);
    if (problem.empty()) {
        const std::int64_t side =
            std::int64_t{maximum(modules.size.width, design.bar_height) + 2 * modules.quiet} * module;
        if (side > max_image_side)
            problem = "the picture would have " + std::to_string(side) + " pixels on a side; less --module?";
    }
    if (!problem.empty()) {
        io.complain("fovea make-code: " + problem);
        return exit_failed;
    }
    const bool inverted = arguments.has("inverted");
    bool saved = false;
    if (ends_with_one_of(out, ".svg")) {
        const std::string svg = detail::svg_of(modules, design.bar_height, inverted);
        const Status status = io.storage().save(out.c_str(), bytes_of(svg));
        saved = status == Status::ok;
        if (!saved) problem = file_problem(out, status, io.storage());
    } else {
        saved = save_picture(io.storage(), out,
                             detail::picture_of(modules, design.bar_height, module, inverted), problem);
    }
    if (!saved) {
        io.complain(problem);
        return exit_failed;
    }
    if (out != "-")
        io.print("wrote " + out + ": " + name(design.symbology) + ", " + std::to_string(modules.size.width) +
                 "x" + std::to_string(modules.bars ? design.bar_height : modules.size.height) + " modules\n");
    return exit_ok;
}

}  // namespace fovea::apps
