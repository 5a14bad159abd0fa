// SPDX-License-Identifier: MIT
//
// OpenCV's YAML, as its samples write calibrations: camera_matrix and distortion_coefficients of one camera,
// M1 D1 M2 D2 with R and T of a pair. The pair's two files may stand behind each other in one text. Files of
// ROS have the names of one camera, too.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <fovea/number/real_text.hpp>

#include <camera/camera_file.hpp>
#include <common/text.hpp>

namespace fovea::apps {

/// Reads one. Nodes that say nothing of cameras are skipped.
CameraFile read_camera_opencv(const std::string& text);

/// Writes one. Call it for files of which opencv_refusal() says nothing.
std::string camera_opencv(const CameraFile& file);

/// What the format cannot hold of a file; "" if it can hold all.
inline std::string opencv_refusal(const CameraFile& file) {
    if (file.stereo() && file.cameras[0].size != file.cameras[1].size)
        return "OpenCV's pairs have pictures of one size";
    return "";
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

class OpencvCameraReader {
public:
    explicit OpencvCameraReader(const std::string& text) : text_(text) {
        file_.format = CameraFormat::opencv;
    }

    CameraFile read() {
        split_nodes();
        if (file_.problem.empty()) static_cast<void>(take_cameras());
        return std::move(file_);
    }

private:
    /// A name at the start of a line and all that belongs to it.
    struct Node {
        std::string name;
        std::string content;
        int line = 1;
    };

    static bool is_figure(char c) { return c >= '0' && c <= '9'; }
    static bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
    bool fail(int line, const std::string& problem) {
        file_.place = {line, 1};
        file_.problem = problem;
        return false;
    }

    void split_nodes() {
        int number = 0;
        for (const std::string& line : split(text_, '\n')) {
            ++number;
            const bool top = !line.empty() && is_letter(line[0]);
            const std::size_t colon = line.find(':');
            if (top && colon != std::string::npos)
                nodes_.push_back({line.substr(0, colon), line.substr(colon + 1) + "\n", number});
            else if (!nodes_.empty() && (line.empty() || (line[0] != '%' && line.compare(0, 3, "---") != 0)))
                nodes_.back().content += line + "\n";
        }
    }

    /// The first of several names.
    const Node* find(const std::vector<const char*>& names) const {
        for (const char* const name : names)
            for (const Node& node : nodes_)
                if (node.name == name) return &node;
        return nullptr;
    }

    /// The words of a node, without what YAML puts between them.
    static std::vector<std::string> words_of(const std::string& content) {
        std::vector<std::string> words;
        bool inside = false;
        for (const char c : content) {
            const bool between = c == ' ' || c == ',' || c == '[' || c == ']' || (c >= '\t' && c <= '\r');
            if (!between && !inside) words.emplace_back();
            if (!between) words.back() += c;
            inside = !between;
        }
        return words;
    }

    /// As C writes numbers: "0." and ".5" too.
    static bool number_of(std::string word, Real& number) {
        const std::size_t point = word.find('.');
        if (point != std::string::npos) {
            if (point + 1 == word.size() || !is_figure(word[point + 1])) word.insert(point + 1, "0");
            if (point == 0 || !is_figure(word[point - 1])) word.insert(point, "0");
        }
        const Result<Real> read = parse_real(span_of(word));
        if (read) number = *read;
        return read.ok();
    }

    bool scalar_in(const Node& node, Real& number) {
        const std::vector<std::string> words = words_of(node.content);
        return (words.size() == 1 && number_of(words[0], number)) ||
               fail(node.line, shortened(node.name, 40) + ": expected a number");
    }

    /// The elements of a matrix whose rows and columns multiply to one of the counts.
    bool matrix_in(const Node& node, const std::vector<std::size_t>& counts, std::vector<Real>& numbers) {
        const std::vector<std::string> words = words_of(node.content);
        std::size_t at = 0;
        while (at < words.size() && words[at] != "data:") ++at;
        if (at == words.size())
            return fail(node.line, node.name + ": expected an opencv-matrix with rows, cols and data");
        for (++at; at < words.size() && numbers.size() <= 14; ++at) {
            numbers.emplace_back();
            if (!number_of(words[at], numbers.back()))
                return fail(node.line,
                            node.name + ": '" + one_line(shortened(words[at], 24)) + "' is no number");
        }
        for (const std::size_t count : counts)
            if (numbers.size() == count && at == words.size()) return true;
        return fail(node.line, node.name + ": expected " + std::to_string(counts[0]) + " numbers as data");
    }

    bool camera_in(const Node& matrix, const Node* lens, CameraRecord& record) {
        std::vector<Real> k;
        if (!matrix_in(matrix, {9}, k)) return false;
        if (!k[1].zero() || !k[3].zero() || !k[6].zero() || !k[7].zero() || k[8] != Real::one())
            return fail(matrix.line, matrix.name + " is not fx 0 cx, 0 fy cy, 0 0 1");
        Camera<>& camera = record.camera;
        camera.fx = k[0];
        camera.cx = k[2];
        camera.fy = k[4];
        camera.cy = k[5];
        if (lens != nullptr) {
            std::vector<Real> d;
            if (!matrix_in(*lens, {5, 4, 8, 12, 14}, d)) return false;
            for (std::size_t i = 5; i < d.size(); ++i)
                if (!d[i].zero())
                    return fail(lens->line, lens->name +
                                                " has more than k1, k2, p1, p2 and k3; calibrate without "
                                                "CALIB_RATIONAL_MODEL and the like");
            camera.k1 = d[0];
            camera.k2 = d[1];
            camera.p1 = d[2];
            camera.p2 = d[3];
            if (d.size() > 4) camera.k3 = d[4];
        }
        const std::string problem = camera_problem(record);
        return problem.empty() || fail(matrix.line, matrix.name + ": " + problem);
    }

    bool size_in(Size& size) {
        const Node* const nodes[2] = {find({"image_width", "image_Width"}),
                                      find({"image_height", "image_Height"})};
        int sides[2] = {};
        for (int i = 0; i < 2; ++i) {
            if (nodes[i] == nullptr) return true;
            Real side;
            if (!scalar_in(*nodes[i], side)) return false;
            if (!(side.positive() && side <= Real::from_int(max_image_side)))
                return fail(nodes[i]->line, nodes[i]->name + " is from 1 to 32767");
            sides[i] = static_cast<int>(side.rounded(0));
        }
        size = {sides[0], sides[1]};
        return true;
    }

    bool take_cameras() {
        if (const Node* model = find({"distortion_model"}))
            for (const std::string& word : words_of(model->content))
                if (word != "plumb_bob" && word != "\"plumb_bob\"" && word != "radtan")
                    return fail(model->line, "the lens model " + one_line(shortened(word, 24)) +
                                                 " is not one that fovea reads: plumb_bob");
        if (const Node* fisheye = find({"fisheye_model"})) {
            Real flag;
            if (!scalar_in(*fisheye, flag)) return false;
            if (!flag.zero()) return fail(fisheye->line, "a fisheye model, which fovea does not read");
        }
        Size size;
        if (!size_in(size)) return false;
        const Node* const left = find({"M1", "K1", "cameraMatrix1"});
        const Node* const right = find({"M2", "K2", "cameraMatrix2"});
        const Node* const single = find({"camera_matrix", "Camera_Matrix", "cameraMatrix", "K"});
        const Node* const rotation = find({"R"});
        const Node* const translation = find({"T"});
        if (left == nullptr && right == nullptr && single == nullptr)
            return fail(
                1, rotation != nullptr && translation != nullptr
                       ? "it holds R and T but no camera; give both files: --camera INTRINSICS,EXTRINSICS"
                       : "it holds no camera_matrix, and no M1 and M2");
        if (left == nullptr && right == nullptr) {
            file_.cameras.resize(1);
            file_.cameras[0].size = size;
            if (const Node* rms = find({"avg_reprojection_error", "Avg_Reprojection_Error"})) {
                Real error;
                if (!scalar_in(*rms, error)) return false;
                file_.cameras[0].rms_px = error.absolute();
            }
            return camera_in(*single,
                             find({"distortion_coefficients", "Distortion_Coefficients", "distCoeffs", "D"}),
                             file_.cameras[0]);
        }
        if (left == nullptr || right == nullptr)
            return fail((left != nullptr ? left : right)->line, "of M1 and M2 one is missing");
        file_.cameras.resize(2);
        for (CameraRecord& record : file_.cameras) record.size = size;
        std::vector<Real> r, t;
        if (!camera_in(*left, find({"D1", "distCoeffs1"}), file_.cameras[0]) ||
            !camera_in(*right, find({"D2", "distCoeffs2"}), file_.cameras[1]))
            return false;
        file_.related = rotation != nullptr && translation != nullptr;
        if (!file_.related) return true;
        if (!matrix_in(*rotation, {9}, r) || !matrix_in(*translation, {3}, t)) return false;
        Pose<>& pose = file_.cameras[1].pose;
        for (int i = 0; i < 9; ++i) pose.rotation(i / 3, i % 3) = r[static_cast<std::size_t>(i)];
        for (int i = 0; i < 3; ++i) pose.translation[i] = t[static_cast<std::size_t>(i)];
        const std::string problem = camera_problem(file_.cameras[1]);
        return problem.empty() || fail(rotation->line, "R and T: " + problem);
    }

    const std::string& text_;
    std::vector<Node> nodes_;
    CameraFile file_;
};

}  // namespace detail

inline CameraFile read_camera_opencv(const std::string& text) {
    return detail::OpencvCameraReader(text).read();
}

inline std::string camera_opencv(const CameraFile& file) {
    std::string text = "%YAML:1.0\n---\n";
    // A number that its reader takes for a real one.
    const auto written = [](Real number) {
        const std::string digits = exact_text(number);
        return digits + (digits.find_first_of(".e") == std::string::npos ? "." : "");
    };
    const auto matrix = [&](const std::string& name, int rows, int columns,
                            const std::vector<Real>& numbers) {
        text += name + ": !!opencv-matrix\n   rows: " + std::to_string(rows) +
                "\n   cols: " + std::to_string(columns) + "\n   dt: d\n   data: [ ";
        for (std::size_t i = 0; i < numbers.size(); ++i)
            text += (i == 0 ? "" : i % 3 == 0 ? ",\n       " : ", ") + written(numbers[i]);
        text += " ]\n";
    };
    const Size size = file.cameras[0].size;
    if (!size.empty())
        text += "image_width: " + std::to_string(size.width) +
                "\nimage_height: " + std::to_string(size.height) + "\n";
    const std::vector<std::string> matrices =
        file.stereo() ? std::vector<std::string>{"M1", "M2"} : std::vector<std::string>{"camera_matrix"};
    for (std::size_t i = 0; i < file.cameras.size(); ++i) {
        const Camera<>& c = file.cameras[i].camera;
        matrix(matrices[i], 3, 3, {c.fx, Real(), c.cx, Real(), c.fy, c.cy, Real(), Real(), Real::one()});
        matrix(file.stereo() ? "D" + std::to_string(i + 1) : "distortion_coefficients", 5, 1,
               {c.k1, c.k2, c.p1, c.p2, c.k3});
    }
    if (!file.stereo()) {
        if (file.cameras[0].rms_px)
            text += "avg_reprojection_error: " + written(*file.cameras[0].rms_px) + "\n";
        return text;
    }
    const Pose<> pose = file.right_from_left();
    std::vector<Real> r, t;
    for (int i = 0; i < 9; ++i) r.push_back(pose.rotation(i / 3, i % 3));
    for (int i = 0; i < 3; ++i) t.push_back(pose.translation[i]);
    matrix("R", 3, 3, r);
    matrix("T", 3, 1, t);
    return text;
}

}  // namespace fovea::apps
