// SPDX-License-Identifier: MIT
//
// The codes of a frame: judged, and told in JSON.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/text_utf8.hpp>
#include <fovea/decision/tolerance.hpp>

#include <common/decimals.hpp>
#include <common/verdicts.hpp>
#include <firmware_read/allowed_texts.hpp>

namespace fovea::apps {

/// Room for so many codes and for the bytes of all their texts.
template <int Codes, std::size_t TextBytes>
class FrameCodes {
public:
    /// Bytes in which a text becomes UTF-8.
    static constexpr std::int64_t utf8_bytes = text_utf8_room(TextBytes);

    CodeText& text() { return text_; }
    ListView<Code> codes() { return codes_; }
    void clear() {
        text_.clear();
        codes_.clear();
    }

    /// nullptr, or why the texts are refused and none is allowed.
    const char* allow(Span<const std::uint8_t> file) {
        judges_ = true;
        allowed_ = AllowedTexts(file);
        return allowed_.count() > 0 ? nullptr : "list refused: no text stands in it";
    }
    const char* missing() const { return judges_ && allowed_.count() == 0 ? "no allowed text" : nullptr; }

    /// By what a reader answered: OK if there is a code and all are allowed. nullptr, or why there is no
    /// verdict.
    const char* judge(Status status, Span<std::uint8_t> utf8, Verdict& verdict) {
        status_ = status;
        verdict = Verdict::not_ok;
        if (status == Status::not_found || status == Status::undecided) return nullptr;
        if (status != Status::ok) return describe(status);
        verdict = Verdict::ok;
        for (const Code& code : codes_)
            if (!is_allowed(code, utf8)) verdict = Verdict::not_ok;
        return nullptr;
    }

    template <class Line>
    void tell(Line& line, Span<std::uint8_t> utf8) const {
        line.text(",\"codes\":[");
        for (int i = 0; i < codes_.size(); ++i) {
            if (i > 0) line.text(",");
            tell_code(line, codes_[i], utf8);
        }
        line.text("]");
        if (codes_.empty()) line.text(",\"reason\":\"").text(describe(status_)).text("\"");
    }
    /// How many texts are allowed, null where all are.
    template <class Line>
    void tell_allowed(Line& line) const {
        line.text(",\"allowed\":");
        if (judges_)
            line.number(allowed_.count());
        else
            line.text("null");
    }

private:
    Result<int> utf8_of(const Code& code, Span<std::uint8_t> utf8) const {
        return text_utf8(text_, code.text_first, code.text_size, utf8);
    }
    bool is_allowed(const Code& code, Span<std::uint8_t> utf8) const {
        if (!judges_) return true;
        const Result<int> size = utf8_of(code, utf8);
        return size && allowed_.contains({utf8.data(), *size});
    }
    template <class Line>
    static void tell_grade(Line& line, const char* name, std::int8_t grade) {
        const char letter[] = {'"', grade < 0 ? '?' : "FDCBA"[grade], '"', '\0'};
        line.text(name).text(grade < 0 ? "null" : letter);
    }
    /// With the keys of `fovea read --json`.
    template <class Line>
    void tell_code(Line& line, const Code& code, Span<std::uint8_t> utf8) const {
        line.text("{\"symbology\":\"").text(name(code.symbology)).text("\",\"text\":");
        const Result<int> size = utf8_of(code, utf8);
        if (size)
            line.string({reinterpret_cast<const char*>(utf8.data()), *size});
        else
            line.text("null,\"reason\":\"").text(describe(size.status())).text("\"");
        const char aim[] = {']', aim_letter(code.symbology), code.aim_digit, '\0'};
        line.text(",\"aim\":\"").text(aim).text("\",\"corners_px\":[");
        for (int i = 0; i < 4; ++i) {
            line.text(i == 0 ? "[" : ",[").decimal(decimal_of(code.corners[i].x), 2);
            line.text(",").decimal(decimal_of(code.corners[i].y), 2).text("]");
        }
        if (code.agreeing_lines > 0)
            line.text("],\"agreeing_lines\":").number(code.agreeing_lines);
        else
            line.text("],\"corrected_errors\":").number(code.corrected_errors);
        line.text(",\"inverted\":").text(code.inverted ? "true" : "false");
        line.text(",\"mirrored\":").text(code.mirrored ? "true" : "false");
        if (code.grade.overall >= 0) {
            tell_grade(line, ",\"grade\":{\"overall\":", code.grade.overall);
            tell_grade(line, ",\"symbol_contrast\":", code.grade.symbol_contrast);
            tell_grade(line, ",\"modulation\":", code.grade.modulation);
            tell_grade(line, ",\"decodability\":", code.grade.decodability);
            tell_grade(line, ",\"quiet_zone\":", code.grade.quiet_zone);
            tell_grade(line, ",\"unused_error_correction\":", code.grade.unused_error_correction);
            line.text("}");
        }
        if (judges_) line.text(",\"verdict\":\"").text(is_allowed(code, utf8) ? "ok" : "not_ok").text("\"");
        line.text("}");
    }

    List<Code, Codes> codes_;
    std::uint8_t text_room_[TextBytes] = {};
    CodeText text_{Span<std::uint8_t>(text_room_)};
    AllowedTexts allowed_;
    bool judges_ = false;
    Status status_ = Status::ok;
};

}  // namespace fovea::apps
