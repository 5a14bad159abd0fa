// SPDX-License-Identifier: MIT
//
// Random views of random objects, many of each: how far cameras and poses are from the same in long double,
// from the truth, and what is refused. Run by hand; its figures are in docs/operators/pose.md.
//   pose_accuracy [COUNT] 1000 of each without a number
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include <fovea/camera/align_points.hpp>
#include <fovea/camera/find_pose.hpp>
#include <fovea/camera/fisheye.hpp>
#include <fovea/camera/fit_projection.hpp>
#include <fovea/camera/p3p.hpp>
#include <fovea/camera/planar_pose.hpp>
#include <fovea/camera/posit.hpp>
#include <fovea/camera/refine_view.hpp>
#include <support/object_scene.hpp>

namespace {

using namespace fovea;
using namespace fovea::test;

/// Errors of one kind: how many, the median, the largest but one percent, and the largest.
class Errors {
public:
    void add(double error) { all_.push_back(error); }
    void print(const char* name) {
        std::sort(all_.begin(), all_.end());
        if (all_.empty()) {
            std::printf("| %s | 0 | - | - | - |\n", name);
            return;
        }
        std::printf("| %s | %d | %.1e | %.1e | %.1e |\n", name, static_cast<int>(all_.size()),
                    all_[all_.size() / 2], all_[all_.size() * 99 / 100], all_.back());
    }

private:
    std::vector<double> all_;
};

double apart(Real a, long double b) {
    return static_cast<double>(std::abs(value_of(a) - b) / std::max(std::abs(b), 1e-30L));
}
/// Like difference(), to a pose in long double.
double apart(const Pose<>& a, const Pose<long double>& b) {
    long double most = 0;
    long double length = 0;
    for (int r = 0; r < 3; ++r) length += b.translation[r] * b.translation[r];
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
            most = std::max(most, std::abs(value_of(a.rotation(r, c)) - b.rotation(r, c)));
        most = std::max(most, std::abs(value_of(a.translation[r]) - b.translation[r]) / std::sqrt(length));
    }
    return static_cast<double>(most);
}
bool in_front(const Pose<>& pose, const std::vector<SpacePoint>& points) {
    for (const SpacePoint point : points)
        if (!(Real::from_int(1) < pose(vector_of(point))[2])) return false;
    return true;
}

void transforms(int count) {
    Random random(101);
    Errors pixels, focal, from_truth;
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        const auto points = random_object(random, 8 + i % 100, 1000);
        const Pose<> pose = random_pose(random, random.between(3000, 12000));
        const auto seen = seen_by(usual_camera(false), pose, points, 0.2, random);
        const auto matrix = fit_projection(span_of(points), span_of(seen));
        const auto wide = fit_projection<long double>(span_of(points), span_of(seen));
        if (!matrix || !wide) {
            ++refused;
            continue;
        }
        double most = 0;
        for (const SpacePoint point : points) {
            const auto a = project(*matrix, vector_of(point)).value();
            const auto b = project(*wide, vector_of<long double>(point)).value();
            for (int r = 0; r < 2; ++r)
                most = std::max(most, static_cast<double>(std::abs(value_of(a[r]) - b[r])));
        }
        pixels.add(most);
        const auto view = decompose(*matrix);
        const auto same = decompose(*wide);
        focal.add(apart(view->camera.fx, same->camera.fx));
        from_truth.add(difference(view->pose, pose));
    }
    std::printf("\n%d refused of %d transforms\n", refused, count);
    pixels.print("transform, px from long double");
    focal.print("its fx, relative, from long double");
    from_truth.print("its pose from the truth, 0.2 px of noise");
}

void views(int count) {
    Random random(102);
    Errors focal, deviations, rms;
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        const auto points = random_object(random, 40 + i % 100, 1000);
        const Pose<> pose = random_pose(random, random.between(3500, 6000));
        const Camera<> camera = usual_camera(true);
        const auto seen = seen_by(camera, pose, points, 0.2, random);
        const auto fit = fit_view(span_of(points), span_of(seen), IntrinsicsOptions());
        const auto wide = fit_view<long double>(span_of(points), span_of(seen), IntrinsicsOptions());
        if (!fit || !wide) {
            ++refused;
            continue;
        }
        focal.add(std::abs(
            static_cast<double>((value_of(fit->camera.fx) - wide->camera.fx) / value_of(fit->deviation.fx))));
        deviations.add(std::abs(plain(fit->camera.fx - camera.fx) / plain(fit->deviation.fx)));
        const double expected = 0.2 * std::sqrt(2.0 - 14.0 / static_cast<double>(points.size()));
        rms.add(std::abs(plain(fit->rms) / expected - 1));
    }
    std::printf("\n%d refused of %d views with lens\n", refused, count);
    focal.print("fx from long double, standard deviations");
    deviations.print("fx from the truth, standard deviations");
    rms.print("rms, part of what noise makes it");
}

void triangles(int count) {
    Random random(103);
    Errors near, far, cylinder, off;
    int none = 0;
    int counts[5] = {};
    int near_cylinder_none = 0;
    for (int i = 0; i < 3 * count; ++i) {
        const int kind = i % 3;
        std::vector<SpacePoint> points = random_object(random, 3, 1000);
        Pose<> pose = random_pose(random, kind == 1 ? 40000000 : random.between(1500, 6000));
        if (kind == 2) {
            // On the cylinder through the points, seen from in front: a circle of radius 625 has such points.
            const int places[6][2] = {{625, 0}, {-175, 600}, {-375, -500},
                                      {0, 625}, {600, -175}, {-500, 375}};
            const int skip = random.between(0, 1);
            for (int k = 0; k < 3; ++k)
                points[static_cast<std::size_t>(k)] = {places[k + 3 * skip][0], places[k + 3 * skip][1], 0};
            const double about = random.next() * 0x1p-32 * 6.28318530717958647;
            const Matrix<3, 3> turn = rotation_about(random_matrix<3, 1>(random) * real_of(0.4));
            const int distance = random.between(1000, 4000);
            const Vector<3> centre(real_of(625 * std::cos(about)), real_of(625 * std::sin(about)),
                                   Real::from_int(-distance));
            pose = {turn, -(turn * centre)};
        }
        if (*spread_of(span_of(points)) != PointSpread::plane || !in_front(pose, points)) continue;
        const auto rays = rays_to(pose, points);
        const auto found = p3p(span_of(points), span_of(rays));
        if (!found) {
            ++(kind == 2 ? near_cylinder_none : none);
            continue;
        }
        if (kind != 2) ++counts[found->count];
        double least = 1e9;
        for (int k = 0; k < found->count; ++k) {
            least = std::min(least, difference(found->poses[k], pose));
            for (std::size_t p = 0; p < 3 && kind != 2; ++p) {
                const Vector<3> place = found->poses[k](vector_of(points[p]));
                off.add(plain(length_of(cross(place, rays[p])) / (length_of(place) * length_of(rays[p]))));
            }
        }
        (kind == 0 ? near : kind == 1 ? far : cylinder).add(least);
    }
    std::printf(
        "\nP3P: %d without a solution, %d of those on the cylinder; solutions 1: %d, 2: %d, 3: %d, 4: %d\n",
        none, near_cylinder_none, counts[1], counts[2], counts[3], counts[4]);
    near.print("P3P, nearest solution from the truth");
    far.print("P3P at 40000 times the size");
    cylinder.print("P3P on the dangerous cylinder");
    off.print("P3P, points off their rays");
}

void objects(int count) {
    Random random(104);
    Errors posit_truth, posit_wide, pose_wide, pose_truth;
    int unsettled = 0;
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        const auto points = random_object(random, 6 + i % 20, 1000);
        const Pose<> pose = random_pose(random, random.between(6000, 30000));
        const auto rays = rays_to(pose, points);
        std::vector<Vector<3, long double>> wide;
        for (const Vector<3>& ray : rays) {
            wide.emplace_back();
            for (int k = 0; k < 3; ++k) wide.back()[k] = value_of(ray[k]);
        }
        const auto found = posit(span_of(points), span_of(rays));
        const auto same = posit<long double>(span_of(points), span_of(wide));
        if (!found || !same) {
            ++unsettled;
        } else {
            posit_truth.add(difference(*found, pose));
            posit_wide.add(apart(*found, *same));
        }
        const Camera<> camera = usual_camera(true);
        const auto seen = seen_by(camera, pose, points, 0.2, random);
        const auto fit = refine_pose(span_of(points), span_of(seen), camera, found ? *found : pose);
        const auto wide_fit =
            refine_pose<long double>(span_of(points), span_of(seen), camera_in<long double>(camera),
                                     pose_in<long double>(found ? *found : pose));
        if (!fit || !wide_fit) {
            ++refused;
            continue;
        }
        pose_wide.add(apart(fit->pose, wide_fit->pose));
        pose_truth.add(std::abs(plain(fit->pose(Vector<3>())[2] - pose(Vector<3>())[2])) /
                       plain(fit->place_deviation[2]));
    }
    std::printf("\nPOSIT: %d of %d do not settle; refinement: %d refused\n", unsettled, count, refused);
    posit_truth.print("POSIT from the truth, exact rays");
    posit_wide.print("POSIT from long double");
    pose_wide.print("refined pose from long double");
    pose_truth.print("its distance from the truth, standard deviations");
}

void planes(int count) {
    Random random(105);
    std::vector<PlanePoint> board;
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 9; ++x) board.push_back({x * 25 - 100, y * 25 - 62});
    std::vector<SubPixelPoint> scratch(54);
    const Camera<> camera = usual_camera(true);
    for (const int distance : {500, 1500, 5000, 15000}) {
        Errors truth, other;
        int one = 0;
        int swapped = 0;
        int refused = 0;
        for (int i = 0; i < count / 4; ++i) {
            Pose<> pose{rotation_about(random_matrix<3, 1>(random) * real_of(1.2)),
                        vector_of({0, 0, distance})};
            const auto seen = seen_by(camera, pose, board, 0.1, random);
            const auto found =
                planar_pose(span_of(board), span_of(seen), camera, Span<SubPixelPoint>(scratch.data(), 54));
            if (!found) {
                ++refused;
                continue;
            }
            const double first = difference(found->fits[0].pose, pose);
            if (found->count == 1) {
                ++one;
                truth.add(first);
                continue;
            }
            const double second = difference(found->fits[1].pose, pose);
            truth.add(std::min(first, second));
            other.add(plain(found->fits[1].rms) / plain(found->fits[0].rms));
            if (second < first) ++swapped;
        }
        std::printf(
            "\nboard of 200 mm at %d mm: %d refused, %d with one pose, %d where the other fits better\n",
            distance, refused, one, swapped);
        truth.print("nearer pose from the truth");
        other.print("rms of the second, of the first");
    }
}

void doubtful(int count) {
    Random random(106);
    const Camera<> camera = usual_camera(true);
    for (const int wrong : {30, 50, 70}) {
        Errors truth;
        int failed = 0;
        int samples = 0;
        int uncertain = 0;
        for (int i = 0; i < count / 4; ++i) {
            const auto points = random_object(random, 100, 1000);
            const Pose<> pose = random_pose(random, 6000);
            auto seen = seen_by(camera, pose, points, 0.2, random);
            for (std::size_t k = 0; k < static_cast<std::size_t>(wrong); ++k)
                seen[k] = {SubPixel::from_int(random.between(0, 639)),
                           SubPixel::from_int(random.between(0, 479))};
            std::vector<Vector<3>> scratch(100);
            std::vector<std::uint8_t> agrees(100);
            RansacOptions options;
            options.seed = static_cast<std::uint64_t>(i);
            options.enough = 15;
            const auto found =
                find_pose(span_of(points), span_of(seen), camera, SubPixel::from_int(2), options,
                          Span<Vector<3>>(scratch.data(), 100), Span<std::uint8_t>(agrees.data(), 100));
            if (!found) {
                ++failed;
                continue;
            }
            samples += found->samples;
            if (!found->certain) ++uncertain;
            truth.add(difference(found->fit.pose, pose));
        }
        std::printf("\n%d of 100 pairs wrong: %d not found, %d uncertain, %.0f samples on average\n", wrong,
                    failed, uncertain, static_cast<double>(samples) / std::max(count / 4 - failed, 1));
        truth.print("pose from the truth");
    }
}

void alignments(int count) {
    Random random(107);
    Errors rotation, size;
    int refused = 0;
    for (int i = 0; i < count; ++i) {
        std::vector<Vector<3>> from, to;
        const Pose<> pose = random_pose(random, 5000);
        const Real scale = Real::from_int(random.between(1, 1000), -5);
        for (int k = 0; k < 3 + i % 50; ++k) {
            from.push_back(random_matrix<3, 1>(random) * Real::from_int(1000));
            to.push_back(pose.rotation * from.back() * scale + pose.translation);
        }
        const auto found = align_points_with_size(span_of(from), span_of(to));
        if (!found) {
            ++refused;
            continue;
        }
        rotation.add(difference(found->pose, pose));
        size.add(std::abs(plain(found->size - scale) / plain(scale)));
    }
    std::printf("\n%d of %d alignments refused\n", refused, count);
    rotation.print("alignment, rotation and translation");
    size.print("alignment, size");
}

void fisheyes(int count) {
    Random random(108);
    Errors off, edge;
    int refused = 0;
    double least = 9;
    for (int i = 0; i < count; ++i) {
        FisheyeCamera<> camera;
        const auto some = [&](double size) { return real_of(size * random.between(-1000, 1000) / 1000); };
        camera.fx = camera.fy = Real::from_int(300);
        camera.k1 = some(0.1);
        camera.k2 = some(0.05);
        camera.k3 = some(0.02);
        camera.k4 = some(0.01);
        const FisheyeLens<> lens(camera);
        least = std::min(least, plain(lens.field()));
        for (int k = 0; k < 20; ++k) {
            const bool at_edge = k == 0;
            const Real angle = lens.field() * (at_edge ? Real::one() - Real::from_int(1, -40)
                                                       : Real::from_int(random.between(1, 990), 0) *
                                                             Real::from_ratio(1, 1000));
            const CosineAndSine<Real> turn(angle);
            const CosineAndSine<Real> about(some(3.14));
            const Vector<3> wanted(turn.sine * about.cosine, turn.sine * about.sine, turn.cosine);
            const auto pixel = lens.project(wanted);
            if (!pixel) {
                ++refused;
                continue;
            }
            const auto ray = lens.ray(*pixel);
            if (!ray) {
                ++refused;
                continue;
            }
            (at_edge ? edge : off).add(plain(length_of(*ray - wanted)));
        }
    }
    std::printf("\nfisheye: %d refused, the smallest field %.2f rad\n", refused, least);
    off.print("fisheye, ray of the pixel of a ray");
    edge.print("the same at the edge of the field");
}

}  // namespace

int main(int count_of_arguments, char** arguments) {
    const int count = count_of_arguments > 1 ? std::atoi(arguments[1]) : 1000;
    if (count < 1) return 1;
    std::printf("| what | number | median | 99 %% | largest |\n|---|---|---|---|---|\n");
    transforms(count);
    views(count);
    triangles(count);
    objects(count);
    planes(count);
    doubtful(count);
    alignments(count);
    fisheyes(count);
    return std::fflush(stdout) == 0 ? 0 : 1;
}
