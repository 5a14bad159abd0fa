// SPDX-License-Identifier: MIT
//
// The text format of the IVT: how many cameras; for each width and height, its matrix, four terms of the
// lens, rotation and translation; for two cameras the corners of the rectified images and the homographies
// that lead from rectified to undistorted pixels.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fovea/linear/matrix.hpp>
#include <fovea/number/real_text.hpp>

#include <camera/camera_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Reads a file of the toolkit. The corners and homographies at its end are checked and not kept: they follow
/// from the rest.
CameraFile read_camera_ivt(const std::string& text);

/// Writes one; for two cameras with the homographies from rectified to undistorted pixels of each. Call it
///        for
/// files of which ivt_refusal() says nothing.
std::string camera_ivt(const CameraFile& file, const Matrix<3, 3> (&rectified)[2]);

/// What the format cannot hold of a file; "" if it can hold all.
inline std::string ivt_refusal(const CameraFile& file) {
    for (const CameraRecord& record : file.cameras) {
        if (!record.camera.k3.zero()) return "the toolkit's format has no k3; calibrate without it";
        if (record.size.empty())
            return "the toolkit's format wants the size of the pictures; write size = [width, height] into a "
                   "camera.toml";
    }
    return "";
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class IvtCameraReader {
public:
    explicit IvtCameraReader(const std::string& text) : text_(text) { file_.format = CameraFormat::ivt; }

    CameraFile read() {
        Real count;
        if (!next(count, "the number of cameras")) return std::move(file_);
        if (count != Real::one() && count != Real::from_int(2)) {
            fail("the number of cameras is 1 or 2");
            return std::move(file_);
        }
        const int cameras = static_cast<int>(count.rounded(0));
        for (int i = 0; i < cameras; ++i)
            if (!read_camera(i == 0 ? "the first camera" : "the second camera")) return std::move(file_);
        // Corners and homographies.
        Real ignored;
        for (int i = 0; cameras == 2 && i < 34; ++i)
            if (!next(ignored, i < 16 ? "the corners of the rectified images" : "the homographies"))
                return std::move(file_);
        skip_blanks();
        if (at_ < text_.size()) fail("something stands behind the last number");
        return std::move(file_);
    }

private:
    bool fail(const std::string& problem) {
        file_.place = place_;
        file_.problem = problem;
        return false;
    }
    void skip_blanks() {
        for (; at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] >= '\t' && text_[at_] <= '\r')); ++at_)
            if (text_[at_] == '\n') {
                ++line_;
                line_start_ = at_ + 1;
            }
        place_ = {line_, static_cast<int>(at_ - line_start_) + 1};
    }
    bool next(Real& number, const std::string& what) {
        skip_blanks();
        const std::size_t start = at_;
        while (at_ < text_.size() && text_[at_] != ' ' && !(text_[at_] >= '\t' && text_[at_] <= '\r')) ++at_;
        const std::string word = text_.substr(start, at_ - start);
        if (word.empty())
            return fail((file_.cameras.empty() ? "the file ends before " : "the file ends within ") + what);
        const Result<Real> read = parse_real(span_of(word));
        if (!read) return fail("'" + one_line(shortened(word, 24)) + "' is no number; of " + what);
        number = *read;
        return true;
    }

    bool read_camera(const std::string& what) {
        file_.cameras.emplace_back();
        CameraRecord& record = file_.cameras.back();
        Real sides[2];
        for (Real& side : sides) {
            if (!next(side, what)) return false;
            if (!(side.positive() && side <= Real::from_int(max_image_side) &&
                  Real::from_int(side.rounded(0)) == side))
                return fail("a side of a picture is a whole number from 1 to 32767; of " + what);
        }
        record.size = {static_cast<int>(sides[0].rounded(0)), static_cast<int>(sides[1].rounded(0))};
        Camera<>& camera = record.camera;
        // fx 0 cx, 0 fy cy, 0 0 1.
        Real skew[6];
        Real* const matrix[9] = {&camera.fx, &skew[0], &camera.cx, &skew[1], &camera.fy,
                                 &camera.cy, &skew[2], &skew[3],   &skew[4]};
        for (Real* const element : matrix)
            if (!next(*element, what)) return false;
        if (!skew[0].zero() || !skew[1].zero() || !skew[2].zero() || !skew[3].zero() ||
            skew[4] != Real::one())
            return fail("the matrix is not fx 0 cx, 0 fy cy, 0 0 1; of " + what);
        for (Real* const term : {&camera.k1, &camera.k2, &camera.p1, &camera.p2})
            if (!next(*term, what)) return false;
        for (int i = 0; i < 9; ++i)
            if (!next(record.pose.rotation(i / 3, i % 3), what)) return false;
        for (int i = 0; i < 3; ++i)
            if (!next(record.pose.translation[i], what)) return false;
        const std::string problem = camera_problem(record);
        return problem.empty() || fail(what + ": " + problem);
    }

    const std::string& text_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::size_t line_start_ = 0;
    TextPlace place_;
    CameraFile file_;
};

}  // namespace detail

inline CameraFile read_camera_ivt(const std::string& text) { return detail::IvtCameraReader(text).read(); }

inline std::string camera_ivt(const CameraFile& file, const Matrix<3, 3> (&rectified)[2]) {
    std::string text = std::to_string(file.cameras.size()) + "\n";
    const auto put = [&](Real number) { text += " " + exact_text(number); };
    for (const CameraRecord& record : file.cameras) {
        text += "\n " + std::to_string(record.size.width) + " " + std::to_string(record.size.height);
        const Camera<>& camera = record.camera;
        for (const Real& number : {camera.fx, Real(), camera.cx, Real(), camera.fy, camera.cy, Real(), Real(),
                                   Real::one(), camera.k1, camera.k2, camera.p1, camera.p2})
            put(number);
        for (int i = 0; i < 9; ++i) put(record.pose.rotation(i / 3, i % 3));
        for (int i = 0; i < 3; ++i) put(record.pose.translation[i]);
        text += "\n";
    }
    if (!file.stereo()) return text;
    // Where the corners of a rectified image come from, as the toolkit has them: (0, 0), (w, 0), (w, h), (0,
    // h).
    for (std::size_t i = 0; i < 2; ++i) {
        text += "\n";
        const Size size = file.cameras[i].size;
        for (int corner = 0; corner < 4; ++corner) {
            const Vector<3> place =
                rectified[i] * Vector<3>(Real::from_int(corner == 1 || corner == 2 ? size.width : 0),
                                         Real::from_int(corner >= 2 ? size.height : 0), Real::one());
            put(place[0] / place[2]);
            put(place[1] / place[2]);
        }
    }
    text += "\n";
    for (const Matrix<3, 3>& homography : rectified) {
        for (int i = 0; i < 9; ++i) put(homography(i / 3, i % 3) / homography(2, 2));
        text += "\n";
    }
    return text;
}

}  // namespace fovea::apps
