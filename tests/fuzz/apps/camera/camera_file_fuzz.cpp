// SPDX-License-Identifier: MIT
//
// Any bytes as a calibration in each format: a problem has words and a place; what is read can be written,
// and is the same when it is read again.
#include <cstddef>
#include <cstdint>
#include <string>

#include <camera/load_camera.hpp>

namespace {

using namespace fovea;
using apps::CameraFile;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

void require_same(const CameraFile& a, const CameraFile& b) {
    require(b.problem.empty() && a.cameras.size() == b.cameras.size());
    for (std::size_t i = 0; i < a.cameras.size(); ++i) {
        require(a.cameras[i].size == b.cameras[i].size);
        require(a.cameras[i].pose.rotation == b.cameras[i].pose.rotation);
        require(a.cameras[i].pose.translation == b.cameras[i].pose.translation);
        for (const apps::CameraParameter& parameter : apps::camera_parameters)
            require(a.cameras[i].camera.*parameter.member == b.cameras[i].camera.*parameter.member);
    }
}

void judge(const CameraFile& file) {
    if (!file.problem.empty()) {
        require(file.place.line >= 1 && file.place.column >= 1);
        return;
    }
    require(file.cameras.size() == 1 || file.cameras.size() == 2);
    for (const apps::CameraRecord& record : file.cameras) require(apps::camera_problem(record).empty());
    require_same(file, apps::read_camera_toml(apps::camera_toml(file)));
    if (apps::ivt_refusal(file).empty()) {
        const Matrix<3, 3> straight[2] = {Matrix<3, 3>::identity(), Matrix<3, 3>::identity()};
        require_same(file, apps::read_camera_ivt(apps::camera_ivt(file, straight)));
    }
    if (file.related && apps::opencv_refusal(file).empty())
        require(apps::read_camera_opencv(apps::camera_opencv(file)).problem.empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    judge(apps::read_camera(text));
    judge(apps::read_camera_toml(text));
    judge(apps::read_camera_ivt(text));
    judge(apps::read_camera_opencv(text));
    return 0;
}
