// SPDX-License-Identifier: MIT
//
// fovea calibrate: a camera, or a pair, from pictures of a board.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <calibrate/calibrate_options.hpp>
#include <calibrate/calibration_pictures.hpp>
#include <calibrate/calibration_report.hpp>
#include <calibrate/calibration_warnings.hpp>
#include <calibrate/camera_estimate.hpp>
#include <calibrate/seen_board.hpp>
#include <camera/camera_command.hpp>
#include <camera/camera_file.hpp>
#include <common/io.hpp>
#include <common/picture_file.hpp>

namespace fovea::apps {

namespace detail {

/// Leaves out pictures that are there before.
inline void leave_out_copies(std::vector<SeenBoard>& boards) {
    for (std::size_t i = 0; i < boards.size(); ++i)
        for (std::size_t j = 0; j < i && boards[i].used; ++j)
            if (boards[j].used && boards[j].crc == boards[i].crc && boards[j].picture == boards[i].picture &&
                boards[j].corners == boards[i].corners) {
                boards[i].used = false;
                boards[i].reason = "the same picture as " + boards[j].name;
            }
}

inline std::string sizes_problem(const std::vector<SeenBoard>& boards) {
    const SeenBoard* first = nullptr;
    for (const SeenBoard& board : boards) {
        // A picture without a board does no harm, whatever it is of.
        if (!board.found) continue;
        if (first == nullptr) first = &board;
        if (board.picture == first->picture) continue;
        const bool turned =
            board.picture.width == first->picture.height && board.picture.height == first->picture.width;
        return board.name + " has " + board_text(board.picture) + " px, " + first->name + " " +
               board_text(first->picture) + "; " +
               (turned ? "one of them is turned: take all the same way up"
                       : "all pictures are of one camera at one resolution");
    }
    return "";
}

template <class Io>
class Calibrator {
public:
    Calibrator(Io& io, const CalibrateOptions& options) : io_(io), options_(options) {}

    ExitCode run() {
        boards_ = see(options_.images, false);
        if (options_.stereo()) right_boards_ = see(options_.right, true);
        if (failed_) return fail("a picture could not be read, or one not be written");
        for (const std::vector<SeenBoard>* boards : {&boards_, &right_boards_}) {
            if (boards->empty()) continue;
            if (const std::string problem = boards_problem(*boards); !problem.empty()) return refuse(problem);
        }
        return options_.stereo() ? run_pair() : run_one();
    }

private:
    /// Looks for the board in pictures, and tells of each.
    std::vector<SeenBoard> see(const std::vector<std::string>& names, bool of_right) {
        std::vector<SeenBoard> boards;
        for (std::size_t i = 0; i < names.size(); ++i) {
            Picture<Gray8> image;
            SeenBoard seen = see_board(io_, names[i], options_.board, image);
            io_.complain(
                names[i] + ": " +
                (seen.found ? std::to_string(seen.corners.size()) + " " + what_is_seen(options_.board.pattern)
                            : seen.reason));
            if (seen.picture.empty()) failed_ = true;
            if (!seen.found && !seen.picture.empty()) missed_.push_back(names[i]);
            const std::string name = options_.explain_name(of_right, i);
            std::string problem;
            if (!name.empty() && !seen.picture.empty() &&
                !save_picture(io_.storage(), name, explain_board(image, seen, options_.board), problem)) {
                io_.complain(problem);
                failed_ = true;
            }
            boards.push_back(std::move(seen));
        }
        leave_out_copies(boards);
        return boards;
    }
    /// Why these pictures are none to calibrate from; "" if they are.
    std::string boards_problem(const std::vector<SeenBoard>& boards) {
        if (std::string problem = sizes_problem(boards); !problem.empty()) return problem;
        if (std::any_of(boards.begin(), boards.end(), [](const SeenBoard& board) { return board.found; }))
            return "";
        const Size other = likely_board();
        return "no picture shows the whole board; " +
               (other.empty()
                    ? "--board counts inner corners, so that 10x7 squares are 9x6; is the board whole "
                      "in the pictures, with a bright rim, sharp and evenly lit?"
                    : "a board of " + board_text(other) + " is seen: give --board " + board_text(other));
    }
    /// The board that was perhaps meant, 0x0 if none is seen. Five pictures are looked at: the first may be
    /// of something else.
    Size likely_board() {
        const std::size_t last = missed_.size() - 1;
        for (std::size_t i = 0; i < 5; ++i) {
            Picture<Gray8> image;
            std::string problem;
            if (i > 0 && last * i / 4 == last * (i - 1) / 4) continue;
            if (!load_picture(io_.storage(), missed_[last * i / 4], max_image_side, image, problem)) continue;
            const Size size = apps::likely_board(image, options_.board);
            if (!size.empty()) return size;
        }
        return {};
    }
    /// Ends without a calibration. What was seen is told to machines all the same.
    ExitCode fail(const std::string& problem) {
        if (options_.json) {
            io_.print(json_views(options_.stereo() ? "left" : "", boards_, {}));
            if (options_.stereo()) io_.print(json_views("right", right_boards_, {}));
            io_.print("{\"rms_px\":null,\"error\":" + json_string(problem) + "}\n");
        }
        return exit_failed;
    }
    ExitCode refuse(const std::string& problem) {
        io_.complain("fovea calibrate: " + problem);
        return fail(problem);
    }

    ExitCode run_one() {
        const CameraEstimate estimate = estimate_camera(boards_, options_.board, options_.intrinsics);
        if (!estimate.verdict.ok())
            return refuse(
                no_calibration("no calibration", estimate.blamed(boards_), estimate.verdict.problem));
        judge_camera(boards_, estimate, "", warnings_);
        const PlanarCalibration<>& found = estimate.calibration;
        const std::string camera =
            human_estimate("camera", boards_, estimate, options_.intrinsics.lens) + "\n";
        if (options_.json)
            io_.print(json_views("", boards_, estimate.views) + "{" +
                      json_estimate(boards_, estimate, found.camera, found.deviation) + "," +
                      json_warnings(warnings_) + "}\n");
        return finish(camera, {record_of(estimate, found.camera, found.deviation)},
                      {{"where the corners were", &boards_, &estimate}});
    }

    ExitCode run_pair() {
        const CameraEstimate left = estimate_camera(boards_, options_.board, options_.intrinsics);
        const CameraEstimate right = estimate_camera(right_boards_, options_.board, options_.intrinsics);
        for (const auto& [estimate, boards, who] :
             {std::tuple{&left, &boards_, "left camera"}, std::tuple{&right, &right_boards_, "right camera"}})
            if (!estimate->verdict.ok())
                return refuse(no_calibration(std::string("no calibration of the ") + who,
                                             estimate->blamed(*boards), estimate->verdict.problem));
        const StereoOptions options = options_.pair();
        const PairEstimate pair = estimate_pair(boards_, right_boards_, left, right, options_.board, options);
        if (pair.views.empty())
            return refuse("no pair shows the board in both pictures; stand where both cameras see all of it");
        if (!pair.verdict.ok()) {
            const int view = pair.verdict.view;
            return refuse(
                no_calibration("no calibration of both together",
                               view < 0 ? "" : boards_[pair.views[static_cast<std::size_t>(view)].seen].name,
                               pair.verdict.problem));
        }
        judge_camera(boards_, left, "left", warnings_);
        judge_camera(right_boards_, right, "right", warnings_);
        judge_pair(boards_, right_boards_, left, right, pair, warnings_);
        const StereoCalibration<>& found = pair.calibration;
        const bool held = options.intrinsics == StereoOptions::Intrinsics::held;
        if (options_.json)
            io_.print(json_views("left", boards_, left.views) +
                      json_views("right", right_boards_, right.views) +
                      json_pair(boards_, right_boards_, left, right, pair, held, warnings_));
        const LensTerms lens = options_.intrinsics.lens;
        const std::string report = human_estimate("left camera", boards_, left, lens) + "\n" +
                                   human_estimate("right camera", right_boards_, right, lens) + "\n" +
                                   human_pair(pair, boards_, options, left.picture, right.picture) + "\n";
        std::vector<CameraRecord> records = {
            record_of(left, found.left, held ? left.calibration.deviation : found.left_deviation),
            record_of(right, found.right, held ? right.calibration.deviation : found.right_deviation)};
        records[1].pose = found.right_from_left;
        records[1].pose.translation = in_millimetres(found.right_from_left.translation);
        stereo_rms_ = found.rms;
        return finish(report, records,
                      {{"left: where the corners were", &boards_, &left},
                       {"right: where the corners were", &right_boards_, &right}});
    }

    static CameraRecord record_of(const CameraEstimate& estimate, const Camera<>& camera,
                                  const Camera<>& deviation) {
        CameraRecord record;
        record.size = estimate.picture;
        record.camera = camera;
        record.deviations = deviation;
        record.rms_px = estimate.calibration.rms;
        return record;
    }

    /// Says what was found, and writes the files.
    ExitCode finish(const std::string& report, const std::vector<CameraRecord>& records,
                    const std::vector<CoveragePanel>& panels) {
        ExitCode code = doubtful(warnings_) ? exit_not_ok : exit_ok;
        std::string problem;
        if (!options_.coverage.empty() &&
            !save_picture(io_.storage(), options_.coverage, coverage_picture(panels), problem)) {
            io_.complain(problem);
            code = exit_failed;
        }
        if (!options_.out.empty() && !write(records)) code = exit_failed;
        const bool for_people = !options_.json && options_.out != "-";
        if (for_people) io_.print(report);
        for (const CalibrationWarning& warning : warnings_) io_.complain("warning: " + warning.text);
        if (!for_people) return code;
        io_.print(human_judgement(warnings_));
        if (!options_.out.empty() && code != exit_failed) io_.print("wrote " + options_.out + "\n");
        return code;
    }
    bool write(const std::vector<CameraRecord>& records) {
        CameraFile file;
        file.format = options_.format;
        file.cameras = records;
        if (file.stereo()) file.stereo_rms_px = stereo_rms_;
        std::string text;
        std::string problem = written_camera(file, options_.out, options_.format, text);
        if (problem.empty())
            if (const Status status = io_.storage().save(options_.out.c_str(), bytes_of(text));
                status != Status::ok)
                problem = file_problem(options_.out, status, io_.storage());
        if (!problem.empty()) io_.complain(problem);
        return problem.empty();
    }

    Io& io_;
    const CalibrateOptions& options_;
    std::vector<SeenBoard> boards_;
    std::vector<SeenBoard> right_boards_;
    std::vector<std::string> missed_;  ///< pictures without a board
    CalibrationWarnings warnings_;
    Real stereo_rms_;
    bool failed_ = false;
};

}  // namespace detail

/// Runs the command with the words behind its name.
template <class Io>
ExitCode calibrate_command(Io& io, const std::vector<std::string>& words) {
    CalibrateOptions options;
    bool help = false;
    const std::string problem = read_calibrate_options(words, options, help);
    if (help) {
        io.print(help_of(calibrate_help()));
        return exit_ok;
    }
    if (!problem.empty()) {
        io.complain("fovea calibrate: " + problem);
        return exit_failed;
    }
    return detail::Calibrator<Io>(io, options).run();
}

}  // namespace fovea::apps
