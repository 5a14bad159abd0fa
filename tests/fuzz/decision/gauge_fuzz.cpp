// SPDX-License-Identifier: MIT
//
// Any recipe on any small picture: gauge() ends, writes nothing when it refuses, says OK of nothing that it
// did not measure, and gives the same whatever its scratch held before.
#include <cstddef>
#include <cstdint>
#include <vector>

#include <fovea/decision/gauge.hpp>
#include <fuzz/decision/recipe_bytes.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

constexpr std::int64_t untouched = -77;

/// What gauge() answered; the list began with one part that stands for those of the frame before.
struct Gauged {
    Status status = Status::ok;
    std::vector<PartResult> parts;
};

Gauged gauge_with(ImageView<const Gray8> image, const Recipe& recipe, int capacity,
                  std::uint8_t scratch_was) {
    const auto bytes = static_cast<std::size_t>(gauge_scratch(image.size(), recipe.locate, capacity));
    std::vector<std::uint8_t> scratch(bytes, scratch_was);
    Gauged gauged;
    gauged.parts.resize(static_cast<std::size_t>(capacity));
    gauged.parts[0].area = untouched;
    int count = 1;
    gauged.status = gauge(image, recipe, {scratch.data(), static_cast<std::ptrdiff_t>(bytes)},
                          ListView<PartResult>(gauged.parts.data(), capacity, &count));
    require(count >= 0 && count <= capacity);
    gauged.parts.resize(static_cast<std::size_t>(count));
    return gauged;
}

void check(const FeatureResult& result, const Feature& feature) {
    if (result.status != Status::ok) {
        require(result.verdict == Verdict::unmeasured);
        return;
    }
    require(result.verdict == judge(result.measurement.value, feature.tolerance));
    require(result.measurement.value.millionths >= 0);
    require(result.measurement.mark_count >= 0 && result.measurement.mark_count <= Measurement::max_marks);
}

void check(const PartResult& part, const Recipe& recipe, Size size) {
    require(part.area >= recipe.locate.area_min && part.area <= recipe.locate.area_max);
    require(!part.box.empty() && part.box.x >= 0 && part.box.y >= 0 && part.box.right() < size.width &&
            part.box.bottom() < size.height);
    require(part.feature_count == recipe.features.size());
    Verdict all = part.pose.orientation == Status::ok ? Verdict::ok : Verdict::unmeasured;
    for (int i = 0; i < part.feature_count; ++i) {
        check(part.features[i], recipe.features[i]);
        if (part.pose.orientation != Status::ok && recipe.features[i].kind != FeatureKind::hole_count)
            require(part.features[i].status == part.pose.orientation);
        all = combine(all, part.features[i].verdict);
    }
    require(part.verdict == all);
}

bool same(const PartResult& a, const PartResult& b) {
    if (a.pose.frame.origin() != b.pose.frame.origin() || a.pose.frame.angle() != b.pose.frame.angle() ||
        a.pose.orientation != b.pose.orientation || a.area != b.area || !(a.box == b.box) ||
        a.holes != b.holes || a.verdict != b.verdict || a.feature_count != b.feature_count)
        return false;
    for (int i = 0; i < a.feature_count; ++i)
        if (a.features[i].status != b.features[i].status || a.features[i].verdict != b.features[i].verdict ||
            a.features[i].measurement.value != b.features[i].measurement.value)
            return false;
    return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    fuzz::Bytes bytes(data, size);
    const fuzz::SmallPicture picture = fuzz::picture_from(bytes);
    const int capacity = 1 + bytes.byte() % 4;
    const Recipe recipe = fuzz::recipe_from(bytes);
    const Gauged gauged = gauge_with(picture.view(), recipe, capacity, 0);
    if (gauged.status != Status::ok && gauged.status != Status::capacity_exceeded) {
        require(gauged.parts.size() == 1 && gauged.parts[0].area == untouched);
        require(gauged.status == Status::bad_argument || gauged.status == Status::degenerate);
        return 0;
    }
    for (const PartResult& part : gauged.parts) check(part, recipe, picture.size);
    const Gauged again = gauge_with(picture.view(), recipe, capacity, 0xa5);
    require(again.status == gauged.status && again.parts.size() == gauged.parts.size());
    for (std::size_t i = 0; i < gauged.parts.size(); ++i) require(same(gauged.parts[i], again.parts[i]));
    return 0;
}
