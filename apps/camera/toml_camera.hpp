// SPDX-License-Identifier: MIT
//
// camera.toml: a calibration as people read it. One table [[camera]] for each camera.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fovea/codec/toml.hpp>
#include <fovea/number/real_text.hpp>

#include <camera/camera_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Reads a camera.toml. Stops at the first mistake: problem then says what, place where.
CameraFile read_camera_toml(const std::string& text);

/// Writes one; what is read from it is the same to the last digit.
std::string camera_toml(const CameraFile& file);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class TomlCameraReader {
public:
    explicit TomlCameraReader(const std::string& text) : reader_(span_of(text), TomlNumbers::as_written) {
        file_.format = CameraFormat::toml;
    }

    CameraFile read() {
        for (;;) {
            const Result<TomlItem> item = reader_.next();
            if (!item) {
                fail(reader_.place(), reader_.problem());
                break;
            }
            if (item->kind == TomlKind::end || !take(*item)) break;
        }
        if (file_.problem.empty() && !format_) fail({1, 1}, "the file lacks format = 1");
        if (file_.problem.empty() && file_.cameras.empty()) fail({1, 1}, "the file has no [[camera]]");
        if (file_.problem.empty()) static_cast<void>(finish_camera());
        return std::move(file_);
    }

private:
    bool fail(TextPlace place, const std::string& problem) {
        file_.place = place;
        file_.problem = problem;
        return false;
    }

    bool take(const TomlItem& item) {
        const std::string name = string_of(item.name);
        if (item.kind == TomlKind::pair)
            return file_.cameras.empty() ? take_top(item, name) : take_key(item, name);
        if (name != "camera")
            return fail(item.place, "unknown table [" + shortened(name, 40) + "]; there is [[camera]]");
        if (item.kind != TomlKind::array_table) return fail(item.place, "cameras are written as [[camera]]");
        if (!file_.cameras.empty() && !finish_camera()) return false;
        if (file_.cameras.size() == 2) return fail(item.place, "more than two cameras");
        file_.cameras.emplace_back();
        seen_.clear();
        table_place_ = item.place;
        return true;
    }

    bool take_top(const TomlItem& item, const std::string& name) {
        if (name == "format") {
            if (format_) return fail(item.place, "format stands twice");
            format_ = true;
            return string_of(item.value.text) == "1" || fail(item.value.place, "format: expected 1");
        }
        if (name == "stereo_rms_px") {
            if (file_.stereo_rms_px) return fail(item.place, "stereo_rms_px stands twice");
            return size_in(item.value, name, file_.stereo_rms_px);
        }
        return fail(item.place, "unknown key " + shortened(name, 40) + " before the first [[camera]]" +
                                    hint(nearest_name(name, {"format", "stereo_rms_px"})));
    }

    bool take_key(const TomlItem& item, const std::string& name) {
        if (std::find(seen_.begin(), seen_.end(), name) != seen_.end())
            return fail(item.place, name + " stands twice");
        seen_.push_back(name);
        CameraRecord& record = file_.cameras.back();
        std::vector<Real> numbers;
        if (name == "size") {
            if (!array_in(item.value, name, 2, numbers)) return false;
            for (const Real& side : numbers)
                if (!(side.positive() && side <= Real::from_int(max_image_side) &&
                      Real::from_int(side.rounded(0)) == side))
                    return fail(item.value.place,
                                "size: expected [width, height] in px, whole numbers up to 32767");
            record.size = {static_cast<int>(numbers[0].rounded(0)), static_cast<int>(numbers[1].rounded(0))};
            return true;
        }
        if (name == "rotation") {
            if (!array_in(item.value, name, 9, numbers)) return false;
            for (int i = 0; i < 9; ++i)
                record.pose.rotation(i / 3, i % 3) = numbers[static_cast<std::size_t>(i)];
            return is_rotation(record.pose.rotation) ||
                   fail(item.value.place,
                        "rotation is none: its rows are not at right angles and of length 1");
        }
        if (name == "translation") {
            if (!array_in(item.value, name, 3, numbers)) return false;
            for (int i = 0; i < 3; ++i) record.pose.translation[i] = numbers[static_cast<std::size_t>(i)];
            return true;
        }
        if (name == "rms_px") return size_in(item.value, name, record.rms_px);
        std::vector<std::string> names = {"size", "rotation", "translation", "rms_px"};
        for (const CameraParameter& parameter : camera_parameters) {
            const std::string deviation = std::string(parameter.name) + "_deviation";
            if (name == parameter.name) return number_in(item.value, name, record.camera.*parameter.member);
            if (name == deviation) {
                std::optional<Real> size;
                if (!size_in(item.value, name, size)) return false;
                if (!record.deviations) record.deviations = none();
                (*record.deviations).*parameter.member = *size;
                return true;
            }
            names.insert(names.end(), {parameter.name, deviation});
        }
        return fail(item.place, "unknown key " + shortened(name, 40) + " in [[camera]]" +
                                    hint(nearest_name(name, names)));
    }

    static Camera<> none() {
        Camera<> zero;
        zero.fx = zero.fy = Real();
        return zero;
    }

    bool number_in(const TomlValue& value, const std::string& name, Real& number) {
        if (value.type != TomlType::integer && value.type != TomlType::decimal)
            return fail(value.place, name + ": expected a number such as 532.25");
        const Result<Real> read = parse_real(value.text);
        if (!read) return fail(value.place, name + ": a number has at most 40 digits and is below 1e60");
        number = *read;
        return true;
    }
    /// One that is not negative.
    bool size_in(const TomlValue& value, const std::string& name, std::optional<Real>& number) {
        Real read;
        if (!number_in(value, name, read)) return false;
        if (read.negative()) return fail(value.place, name + " is not below 0");
        number = read;
        return true;
    }
    bool array_in(const TomlValue& value, const std::string& name, std::size_t count,
                  std::vector<Real>& numbers) {
        const std::string expected = name + ": expected an array of " + std::to_string(count) + " numbers";
        if (value.type != TomlType::array) return fail(value.place, expected);
        TomlArrayReader elements(value, TomlNumbers::as_written);
        for (Result<TomlValue> each = elements.next(); each; each = elements.next()) {
            numbers.emplace_back();
            if (!number_in(*each, name, numbers.back())) return false;
        }
        return numbers.size() == count ||
               fail(value.place, expected + ", not " + std::to_string(numbers.size()));
    }

    /// What a camera must have.
    bool finish_camera() {
        const auto has = [&](const std::string& name) {
            return std::find(seen_.begin(), seen_.end(), name) != seen_.end();
        };
        for (const CameraParameter& parameter : camera_parameters)
            if (parameter.required && !has(parameter.name))
                return fail(table_place_,
                            std::string("[[camera]] lacks ") + parameter.name + ": " + parameter.text);
        const std::string problem = camera_problem(file_.cameras.back());
        return problem.empty() || fail(table_place_, problem);
    }

    TomlReader reader_;
    CameraFile file_;
    bool format_ = false;
    TextPlace table_place_;
    std::vector<std::string> seen_;
};

}  // namespace detail

inline CameraFile read_camera_toml(const std::string& text) { return detail::TomlCameraReader(text).read(); }

inline std::string camera_toml(const CameraFile& file) {
    std::string text =
        "# A calibration. Lengths of the image are in px, of the lens at distance 1; k1 to p2 as in "
        "OpenCV.\nformat = 1\n";
    const auto array = [](std::initializer_list<Real> numbers) {
        std::string list;
        for (const Real& number : numbers) list += (list.empty() ? "[" : ", ") + exact_text(number);
        return list + "]";
    };
    if (file.stereo_rms_px) text += "stereo_rms_px = " + exact_text(*file.stereo_rms_px) + "\n";
    for (const CameraRecord& record : file.cameras) {
        text += "\n[[camera]]\n";
        if (!record.size.empty())
            text += "size = [" + std::to_string(record.size.width) + ", " +
                    std::to_string(record.size.height) + "]\n";
        for (const CameraParameter& parameter : camera_parameters)
            text += std::string(parameter.name) + " = " + exact_text(record.camera.*parameter.member) + "\n";
        const Pose<>& pose = record.pose;
        const Matrix<3, 3>& r = pose.rotation;
        const bool placed = r != Matrix<3, 3>::identity() || pose.translation != Vector<3>();
        if (placed) {
            text += "# Into this camera's coordinates: rotation x + translation, rows of the rotation.\n";
            text += "rotation = " +
                    array({r(0, 0), r(0, 1), r(0, 2), r(1, 0), r(1, 1), r(1, 2), r(2, 0), r(2, 1), r(2, 2)}) +
                    "\n";
            text +=
                "translation = " + array({pose.translation[0], pose.translation[1], pose.translation[2]}) +
                "\n";
        }
        if (record.rms_px) text += "rms_px = " + exact_text(*record.rms_px) + "\n";
        if (record.deviations)
            for (const CameraParameter& parameter : camera_parameters)
                text += std::string(parameter.name) +
                        "_deviation = " + exact_text((*record.deviations).*parameter.member) + "\n";
    }
    return text;
}

}  // namespace fovea::apps
