// SPDX-License-Identifier: MIT
//
// Inspection: one trigger and what came of it, as it goes out on every way.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/symbology.hpp>
#include <fovea/decision/tolerance.hpp>
#include <fovea/draw/utf8.hpp>
#include <fovea/number/decimal.hpp>

#include <common/decimals.hpp>
#include <common/verdicts.hpp>
#include <daemon/tally.hpp>
#include <daemon/text_buffer.hpp>
#include <read/code_escape.hpp>
#include <read/code_readings.hpp>

namespace fovea::apps {

/// A feature of a part as it was measured. value counts where status is ok.
struct InspectedValue {
    Span<const char> name;
    Status status = Status::not_found;
    Verdict verdict = Verdict::unmeasured;
    Decimal value;
    /// Of the printed value: 0 for what is counted.
    int places = 3;
};

struct Inspection {
    static constexpr int most_values = 32;

    /// Of the trigger, from 1.
    std::uint64_t number = 0;
    Answer answer = Answer::error;
    /// One word for what was wrong first; empty for OK.
    const char* reason = "";
    /// The feature that was wrong first, if it was one.
    Span<const char> feature;

    int job_number = 0;
    Span<const char> job;
    std::uint32_t job_crc = 0;

    bool has_frame = false;
    std::uint32_t frame = 0;
    std::int64_t age_us = 0;
    std::uint64_t missed_frames = 0;
    /// From the trigger to the answer, and of that for the judgement.
    std::int64_t took_us = 0;
    std::int64_t judged_us = 0;
    std::int64_t time_us = 0;

    int parts = 0;
    /// Of the part that is worst; the first of equals.
    int values = 0;
    InspectedValue value[most_values];

    /// The job looks for codes; these were read.
    bool reads_codes = false;
    Span<const CodeReading> codes;

    /// Nothing is known of a picture yet.
    void clear() {
        has_frame = false;
        reason = "";
        feature = {};
        parts = values = 0;
        codes = {};
        judged_us = 0;
    }
};

/// Writes the text of a code as a JSON string. What only some readers take for the end of a line is escaped,
/// too.
inline void write_json_text(Span<const char> text, TextBuffer& line) {
    line.put('"');
    while (!text.empty()) {
        const CodePoint read = first_code_point(text);
        if (disturbing_bytes(text) > 0)
            line.text("\\u").hex(read.value, 4);
        else if (text[0] == '"' || text[0] == '\\')
            line.put('\\').put(text[0]);
        else
            line.text(text.first(read.bytes));
        text = text.from(read.bytes);
    }
    line.put('"');
}

/// The codes as an array of JSON, as many bytes as texts of CodeReadings::most_text take at most: 9 kB.
inline void write_json_codes(Span<const CodeReading> codes, TextBuffer& line) {
    line.put('[');
    for (const CodeReading& reading : codes) {
        const Code& code = reading.code;
        line.text(&reading == codes.begin() ? "{\"symbology\":\"" : ",{\"symbology\":\"")
            .text(name(code.symbology));
        write_json_text(reading.text, line.text("\",\"text\":"));
        line.text(",\"bytes_hex\":\"");
        for (const std::uint8_t byte : reading.bytes) line.hex(byte, 2);
        line.text("\",\"aim\":\"]")
            .put(aim_letter(code.symbology))
            .put(code.aim_digit)
            .text("\",\"corners_px\":[");
        for (int k = 0; k < 4; ++k) {
            line.text(k == 0 ? "[" : ",[").decimal(decimal_of(code.corners[k].x), 2);
            line.put(',').decimal(decimal_of(code.corners[k].y), 2).put(']');
        }
        line.text("],\"grade\":");
        if (code.grade.overall < 0)
            line.text("null");
        else
            line.put('"').put("FDCBA"[code.grade.overall]).put('"');
        line.text(",\"why\":");
        if (reading.fault[0] == '\0')
            line.text("null}");
        else
            line.put('"').text(reading.fault).text("\"}");
    }
    line.put(']');
}

/// Writes a result as a line of JSON without its end, keys in a fixed order. Numbers carry their unit in the
/// key; a value is in the unit of its job.
inline void write_json(const Inspection& inspection, TextBuffer& line) {
    line.text("{\"v\":1,\"ev\":\"result\",\"seq\":").number(static_cast<std::int64_t>(inspection.number));
    line.text(",\"t_mono_us\":").number(inspection.time_us);
    line.text(",\"job\":").json(inspection.job);
    line.text(",\"job_crc\":\"").hex(inspection.job_crc, 8).text("\",\"frame\":");
    if (inspection.has_frame)
        line.text("{\"seq\":")
            .number(inspection.frame)
            .text(",\"age_us\":")
            .number(inspection.age_us)
            .text(",\"missed\":")
            .number(static_cast<std::int64_t>(inspection.missed_frames))
            .text("}");
    else
        line.text("null");
    line.text(",\"verdict\":\"").text(word_of(inspection.answer)).text("\",\"why\":");
    if (inspection.reason[0] == '\0')
        line.text("null");
    else if (inspection.feature.empty())
        line.text("\"").text(inspection.reason).text("\"");
    else
        line.text("\"").text(inspection.reason).text("\",\"feature\":").json(inspection.feature);
    line.text(",\"parts\":").number(inspection.parts).text(",\"values\":[");
    for (int k = 0; k < inspection.values; ++k) {
        const InspectedValue& value = inspection.value[k];
        line.text(k == 0 ? "{\"name\":" : ",{\"name\":").json(value.name).text(",\"value\":");
        if (value.status == Status::ok)
            line.decimal(value.value, value.places == 0 ? 0 : 6);
        else
            line.text("null,\"reason\":\"").text(describe(value.status)).text("\"");
        line.text(",\"verdict\":\"").text(word_of(value.verdict)).text("\"}");
    }
    line.put(']');
    if (inspection.reads_codes) write_json_codes(inspection.codes, line.text(",\"codes\":"));
    line.text(",\"us\":{\"answer\":").number(inspection.took_us);
    line.text(",\"judge\":").number(inspection.judged_us).text("}}");
}

}  // namespace fovea::apps
