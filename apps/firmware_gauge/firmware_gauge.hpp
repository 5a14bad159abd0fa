// SPDX-License-Identifier: MIT
//
// What a board does with frames that it gauges.
#pragma once

#include <cstddef>
#include <cstdint>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/decision/compiled_recipe.hpp>
#include <fovea/decision/gauge.hpp>
#include <fovea/decision/recipe.hpp>
#include <fovea/image/image_view.hpp>

#include <common/decimals.hpp>
#include <common/verdicts.hpp>
#include <firmware/frame_firmware.hpp>

namespace fovea::apps {

/// All memory of the firmware, known when it is compiled.
template <std::size_t FrameBytes, std::size_t ScratchBytes, std::size_t LineBytes, int Features, int Parts>
struct GaugeMemory {
    static constexpr std::int64_t frame_bytes = FrameBytes;
    static constexpr std::int64_t line_bytes = LineBytes;

    RecipeOf<Features> recipe;
    List<PartResult, Parts> parts;
    /// Of the gauge; until a frame is whole, of the packet that arrives: a line, or a recipe.
    alignas(8) std::uint8_t scratch[ScratchBytes];
    std::uint8_t frame[FrameBytes];

    static constexpr std::ptrdiff_t packet_bytes = line_packet_bytes(LineBytes);
    static_assert(packet_bytes <= ScratchBytes, "a line must find room");
    Span<std::uint8_t> packet() { return {scratch, packet_bytes}; }
};

/// The job of FrameFirmware.
template <class Memory>
class GaugeJob {
public:
    static constexpr bool takes_recipes = true;

    explicit GaugeJob(Memory& memory) : memory_(memory) {}

    Span<std::uint8_t> packet_room() { return memory_.packet(); }

    const char* load(Span<const std::uint8_t> bytes) {
        switch (decode_recipe(bytes, memory_.recipe)) {
            case Status::ok: has_recipe_ = true; return nullptr;
            case Status::unsupported: return "recipe refused: of another version";
            case Status::truncated: return "recipe refused: it ends too early";
            case Status::capacity_exceeded:
                return "recipe refused: more features than this board has room for";
            default: return "recipe refused: damaged";
        }
    }
    const char* missing() const { return has_recipe_ ? nullptr : "no recipe"; }

    const char* begin(Size size) {
        size_ = size;
        return size.area() > Memory::frame_bytes ? "frame too large" : nullptr;
    }
    void take_line(int y, Span<const std::uint8_t> pixels) {
        std::uint8_t* row = memory_.frame + std::ptrdiff_t{y} * size_.width;
        for (int x = 0; x < size_.width; ++x) row[x] = pixels[x];
    }

    const char* judge(Verdict& verdict) {
        const ImageView<const Gray8> image(memory_.frame, size_, size_.width);
        memory_.parts.clear();
        const Status status = gauge(image, memory_.recipe, memory_.scratch, memory_.parts);
        if (status != Status::ok) return describe(status);
        if (memory_.parts.empty()) return "no part";
        verdict = Verdict::ok;
        for (const PartResult& part : memory_.parts) verdict = combine(verdict, part.verdict);
        return nullptr;
    }

    template <class Line>
    void tell_judged(Line& line) const {
        line.text(",\"parts\":[");
        for (int i = 0; i < memory_.parts.size(); ++i) {
            if (i > 0) line.text(",");
            tell_part(line, memory_.parts[i]);
        }
        line.text("]");
    }
    template <class Line>
    void tell_state(Line& line) const {
        line.text(",\"recipe\":");
        if (has_recipe_)
            line.string(name_of(memory_.recipe.name));
        else
            line.text("null");
        line.text(",\"features\":").number(memory_.recipe.features.size());
        line.text(",\"frame_bytes\":").number(Memory::frame_bytes);
        line.text(",\"line_bytes\":").number(Memory::line_bytes);
    }

private:
    template <class Line>
    void tell_part(Line& line, const PartResult& part) const {
        const PartFrame& frame = part.pose.frame;
        line.text("{\"x\":").decimal(decimal_of(frame.origin().x), 3);
        line.text(",\"y\":").decimal(decimal_of(frame.origin().y), 3);
        line.text(",\"angle_deg\":").decimal(decimal_of(frame.angle()), 4);
        line.text(",\"area_px\":").number(part.area).text(",\"holes\":").number(part.holes);
        line.text(",\"features\":[");
        for (int i = 0; i < part.feature_count; ++i) {
            const Feature& feature = memory_.recipe.features[i];
            const FeatureResult& result = part.features[i];
            const int places = feature.kind == FeatureKind::hole_count ? 0 : 6;
            line.text(i == 0 ? "{\"name\":" : ",{\"name\":").string(name_of(feature.name));
            if (result.status == Status::ok)
                line.text(",\"value\":").decimal(result.measurement.value, places);
            else
                line.text(",\"value\":null,\"reason\":\"").text(describe(result.status)).text("\"");
            line.text(",\"verdict\":\"").text(word_of(result.verdict)).text("\"}");
        }
        line.text("],\"verdict\":\"").text(word_of(part.verdict)).text("\"}");
    }

    Memory& memory_;
    Size size_{};
    bool has_recipe_ = false;
};

}  // namespace fovea::apps
