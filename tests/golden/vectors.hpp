// SPDX-License-Identifier: MIT
//
// Golden vectors: what every operator makes of fixed inputs, as a checksum. The integer is the specification,
// so a compiler, an instruction set or a chip that computes another checksum computes something else.
//
// The table of expected ones is golden.txt. It is written by the program golden_table; a changed line is
// news.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/catalogue/catalogue.hpp>
#include <golden/base_vectors.hpp>
#include <golden/board_vectors.hpp>
#include <golden/calibration_vectors.hpp>
#include <golden/camera_vectors.hpp>
#include <golden/code_bar_vectors.hpp>
#include <golden/code_blur_vectors.hpp>
#include <golden/code_data_matrix_vectors.hpp>
#include <golden/code_qr_vectors.hpp>
#include <golden/codec_vectors.hpp>
#include <golden/colour_vectors.hpp>
#include <golden/decision_vectors.hpp>
#include <golden/digest.hpp>
#include <golden/draw_vectors.hpp>
#include <golden/feature_vectors.hpp>
#include <golden/filter_vectors.hpp>
#include <golden/image_vectors.hpp>
#include <golden/light_section_vectors.hpp>
#include <golden/match_vectors.hpp>
#include <golden/measure_vectors.hpp>
#include <golden/morphology_vectors.hpp>
#include <golden/motion_vectors.hpp>
#include <golden/number_vectors.hpp>
#include <golden/operator_vectors.hpp>
#include <golden/pose_vectors.hpp>
#include <golden/segment_vectors.hpp>
#include <golden/statistics_vectors.hpp>
#include <golden/stereo_vectors.hpp>
#include <golden/stream_vectors.hpp>
#include <golden/warp_vectors.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

struct Vector {
    const char* name;
    void (*compute)(Workspace& work, Digest& digest);
    const Operator* op = nullptr;  ///< an entry of the catalogue in place of compute
};

inline constexpr Vector vectors[] = {
    {"base/containers", base_containers},
    {"base/crc32", base_crc32},
    {"base/nearly_ordered", base_nearly_ordered},
    {"base/order", base_order},
    {"base/random", base_random},
    {"number/angle_and_fixed", number_angle},
    {"number/arctangent", number_arctangent},
    {"number/decimal", number_decimal},
    {"number/int128", number_int128},
    {"number/integer", number_integer},
    {"number/real", number_real},
    {"number/real_text", number_real_text},
    {"number/root", number_root},
    {"number/trigonometry", number_trigonometry},
    {"number/wide", number_wide},
    {"linear/cubic", linear_cubic},
    {"linear/block_equations", linear_block_equations},
    {"linear/eigen", linear_eigen},
    {"linear/levenberg_marquardt", linear_levenberg_marquardt},
    {"linear/matrices", linear_matrices},
    {"linear/solvers", linear_solvers},
    {"simd/lanes", simd_lanes},
    {"simd/words", simd_words},
    {"image/row_kernel", image_row_kernel},
    {"image/views", image_views},
    {"stream/filters", stream_filters},
    {"stream/morphology", stream_morphology},
    {"stream/points", stream_points},
    {"stream/accumulators", stream_accumulators},
    {"stream/components", stream_components},
    {"simd/interleave", simd_interleave},
    {"pixelwise/colour_class", pixelwise_colour_class},
    {"pixelwise/colour_model", pixelwise_colour_model},
    {"pixelwise/frames", pixelwise_frames},
    {"pixelwise/hsv", pixelwise_hsv},
    {"pixelwise/lab", pixelwise_lab},
    {"pixelwise/planes", pixelwise_planes},
    {"pixelwise/tables", pixelwise_tables},
    {"pixelwise/threshold", pixelwise_threshold},
    {"pixelwise/to_gray", pixelwise_to_gray},
    {"pixelwise/video", pixelwise_video},
    {"statistics/binary_moments", statistics_binary_moments},
    {"statistics/distances", statistics_distances},
    {"statistics/histogram", statistics_histogram},
    {"statistics/hu_moments", statistics_hu_moments},
    {"statistics/integral", statistics_integral},
    {"statistics/masked_histogram", statistics_masked_histogram},
    {"statistics/moments", statistics_moments},
    {"statistics/polygon_moments", statistics_polygon_moments},
    {"statistics/polygon_symmetry", statistics_polygon_symmetry},
    {"statistics/projection", statistics_projection},
    {"statistics/reductions", statistics_reductions},
    {"morphology/bits", morphology_bits},
    {"filter/convolve", filter_convolve},
    {"morphology/rectangles", morphology_rectangles},
    {"morphology/shapes", morphology_shapes},
    {"morphology/thinning", morphology_thinning},
    {"warp/bilinear", warp_bilinear},
    {"warp/curved_maps", warp_curved_maps},
    {"warp/homographies", warp_homographies},
    {"warp/maps", warp_maps},
    {"warp/polar_places", warp_polar_places},
    {"warp/transforms", warp_transforms},
    {"segment/connected_components", segment_connected_components},
    {"segment/contours", segment_contours},
    {"segment/fine_moments", segment_fine_moments},
    {"segment/growing", segment_growing},
    {"segment/label_image", segment_label_image},
    {"segment/level_contour", segment_level_contour},
    {"segment/polygons", segment_polygons},
    {"segment/runs", segment_runs},
    {"feature/canny_points", feature_canny_points},
    {"feature/find_circles", feature_find_circles},
    {"feature/harris_points", feature_harris_points},
    {"feature/hough_circles", feature_hough_circles},
    {"feature/hough_lines", feature_hough_lines},
    {"match/fits", match_fits},
    {"match/ransac", match_ransac},
    {"measure/edge_probe", measure_edge_probe},
    {"measure/edge_straightness", measure_edge_straightness},
    {"measure/fit_circle", measure_fit_circle},
    {"measure/fit_line", measure_fit_line},
    {"measure/half_turn", measure_half_turn},
    {"measure/least_median", measure_least_median},
    {"measure/ransac", measure_ransac},
    {"measure/run_widths", measure_run_widths},
    {"light_section/line_peaks", light_section_line_peaks},
    {"motion/blocks", motion_blocks},
    {"camera/alignment", camera_alignment},
    {"camera/calibrate_planar", camera_calibrate_planar},
    {"camera/find_pose", camera_find_pose},
    {"camera/fisheye", camera_fisheye},
    {"camera/checkerboard", camera_checkerboard},
    {"camera/circle_grid", camera_circle_grid},
    {"camera/lens", camera_lens},
    {"camera/object_pose", camera_object_pose},
    {"camera/packed", camera_packed},
    {"camera/planar_pose", camera_planar_pose},
    {"camera/poses", camera_poses},
    {"camera/projection", camera_projection},
    {"camera/projection_derivatives", camera_projection_derivatives},
    {"camera/undistortion", camera_undistortion},
    {"camera/view_fit", camera_view_fit},
    {"camera/views", camera_views},
    {"stereo/calibrate_stereo", stereo_calibrate_stereo},
    {"stereo/epipolar", stereo_epipolar},
    {"stereo/essential", stereo_essential},
    {"stereo/essential_ransac", stereo_essential_ransac},
    {"stereo/fundamental", stereo_fundamental},
    {"stereo/ransac", stereo_ransac},
    {"stereo/rectify", stereo_rectify},
    {"stereo/rectify_zoom", stereo_rectify_zoom},
    {"stereo/triangulate", stereo_triangulate},
    {"code/blurred_ean", code_blurred_ean},
    {"code/read_blurred_bars", code_read_blurred_bars},
    {"code/local_threshold", code_local_threshold},
    {"code/names", code_names},
    {"code/qr_symbols", code_qr_symbols},
    {"code/read_qr", code_read_qr},
    {"code/reed_solomon", code_reed_solomon},
    {"code/text_utf8", code_text_utf8},
    {"code/bar_decoders", code_bar_decoders},
    {"code/bar_encoders", code_bar_encoders},
    {"code/bar_lines", code_bar_lines},
    {"code/bar_tables", code_bar_tables},
    {"code/bar_votes", code_bar_votes},
    {"code/read_bars", code_read_bars},
    {"code/data_matrix_symbols", code_data_matrix_symbols},
    {"code/read_data_matrix", code_read_data_matrix},
    {"codec/any_picture", codec_any_picture},
    {"codec/bmp", codec_bmp},
    {"codec/encode_bmp", codec_encode_bmp},
    {"codec/encode_png", codec_encode_png},
    {"codec/encode_pnm", codec_encode_pnm},
    {"codec/jpeg", codec_jpeg},
    {"codec/jpeg_parts", codec_jpeg_parts},
    {"codec/packet", codec_packet},
    {"codec/png", codec_png},
    {"codec/pnm", codec_pnm},
    {"codec/toml", codec_toml},
    {"codec/zlib", codec_zlib},
    {"draw/circles", draw_circles},
    {"draw/lines", draw_lines},
    {"draw/marks", draw_marks},
    {"draw/polygons", draw_polygons},
    {"draw/rectangles", draw_rectangles},
    {"draw/texts", draw_texts},
    {"draw/utf8", draw_utf8},
    {"decision/compiled_recipe", decision_compiled_recipe},
    {"decision/gauge", decision_gauge},
    {"decision/gauge_by_workers", decision_gauge_by_workers},
    {"decision/locate", decision_locate},
    {"decision/measure_feature", decision_measure_feature},
    {"decision/part_frame", decision_part_frame},
    {"decision/tolerance", decision_tolerance},
};

/// visit(vector) for all of them, then for every operator of the catalogue.
template <class Visit>
void for_each_vector(Visit visit) {
    for (const Vector& vector : vectors) visit(vector);
    for (const OperatorFamily& family : operator_families)
        for (const Operator& op : family.operators) visit(Vector{op.name, nullptr, &op});
}

/// The checksum of one vector. The workspace is shared, and cleared first.
inline std::uint32_t checksum(const Vector& vector, Workspace& work) {
    for (auto& image : work.image)
        for (std::uint8_t& byte : image) byte = 0;
    for (std::uint8_t& byte : work.scratch) byte = 0xa5;
    work.regions.clear();
    work.holes.clear();
    Digest digest;
    if (vector.op != nullptr)
        operator_vector(*vector.op, work, digest);
    else
        vector.compute(work, digest);
    return digest.value();
}

}  // namespace fovea::golden
