// SPDX-License-Identifier: MIT
//
// How exact the geometry of two cameras is: 200 random pairs with noise, and Real beside numbers of 113
// digits. Run by hand (`cmake --build build/host --target stereo_accuracy`, then
// build/host/tests/stereo_accuracy); the figures stand in docs/operators/stereo.md. Prints Markdown.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <fovea/stereo/eight_point.hpp>
#include <fovea/stereo/essential.hpp>
#include <fovea/stereo/ransac_epipolar.hpp>
#include <fovea/stereo/rectify.hpp>
#include <fovea/stereo/rectify_uncalibrated.hpp>
#include <fovea/stereo/triangulate.hpp>
#include <support/stereo_rigs.hpp>

__extension__ typedef __float128 Quad;

namespace fovea {

Quad quad_of(const Real& number) {
    Quad value = static_cast<Quad>(number.mantissa());
    int exponent = number.zero() ? 0 : number.exponent() - 63;
    for (; exponent > 0; --exponent) value *= 2;
    for (; exponent < 0; ++exponent) value /= 2;
    return number.negative() ? -value : value;
}

template <>
struct ScalarTraits<Quad> {
    static Quad from_int(std::int64_t value, int exponent) {
        return scale(static_cast<Quad>(value), exponent);
    }
    static Quad square_root(Quad a) {
        const Quad size = absolute(a);
        if (size == 0) return 0;
        Quad root = static_cast<Quad>(std::sqrt(static_cast<long double>(size)));
        for (int i = 0; i < 2; ++i) root = (root + size / root) / 2;
        return root;
    }
    static Quad absolute(Quad a) { return a < 0 ? -a : a; }
    static Quad scale(Quad a, int bits) {
        const Quad factor = static_cast<Quad>(std::ldexp(1.0L, std::abs(bits)));
        return bits < 0 ? a / factor : a * factor;
    }
    static std::int64_t rounded(Quad a, int bits) {
        const Quad raised = scale(absolute(a), bits) + static_cast<Quad>(0.5);
        const auto whole = static_cast<std::int64_t>(raised);
        return a < 0 ? -whole : whole;
    }
};

}  // namespace fovea

namespace {

using namespace fovea;
using namespace fovea::test;

/// Root of the mean square, and the largest.
class Errors {
public:
    void add(double error) {
        squares_ += error * error;
        largest_ = std::max(largest_, std::abs(error));
        ++count_;
    }
    void print() const {
        std::printf(" %.2g, %.2g |", count_ == 0 ? 0 : std::sqrt(squares_ / count_), largest_);
    }

private:
    double squares_ = 0, largest_ = 0;
    int count_ = 0;
};

double plain(const Real& value) { return plain_number(value); }
double apart(const Real& a, Quad b) {
    const Quad off = quad_of(a) - b;
    return static_cast<double>(off < 0 ? -off : off);
}
template <int Rows, int Columns>
double apart(const Matrix<Rows, Columns>& a, const Matrix<Rows, Columns, Quad>& b) {
    double most = 0;
    for (int r = 0; r < Rows; ++r)
        for (int c = 0; c < Columns; ++c) most = std::max(most, apart(a(r, c), b(r, c)));
    return most;
}
Vector<2> rectified_pixel(const LensInverse<>& lens, const Matrix<3, 3>& rotation, const Camera<>& camera,
                          SubPixelPoint pixel) {
    return *project(camera, rotation * *lens.ray(vector_of<Real>(pixel)));
}

struct Study {
    Errors rows, midpoint, optimal, disparity, turn, baseline, uncalibrated, epipolar;
    int failures = 0, agreeing = 0, wrong = 0, uncertain = 0;

    void one_rig(Random& random, double noise, int index) {
        const auto kind = index % 4 == 3 ? RandomRig::Kind::one_above : RandomRig::Kind::side_by_side;
        const RandomRig rig(random, kind);
        const StereoCamera<double> pair = rig.cameras<double>();
        const StereoCamera<> cameras = rig.cameras<Real>();
        const SeenPlaces seen = look_at(pair, random, 100, noise);
        with_cameras(cameras, seen);
        from_rays(cameras, seen, random);
        // Pixels without lens, for what does not know the cameras.
        const RandomRig plain_rig(random, kind, false);
        const SeenPlaces flat = look_at(plain_rig.cameras<double>(), random, 100, noise);
        from_pixels(plain_rig.cameras<Real>(), flat, random);
    }

    void with_cameras(const StereoCamera<>& cameras, const SeenPlaces& seen) {
        const Result<Rectification<>> found = rectify(cameras, Size{640, 480});
        if (!found) {
            ++failures;
            return;
        }
        const Triangulator<> eyes(cameras);
        const LensInverse<> left(cameras.left);
        const LensInverse<> right(cameras.right);
        const int axis = found->axis == StereoAxis::x ? 0 : 1;
        for (std::size_t i = 0; i < seen.places.size(); ++i) {
            const Vector<2> a = rectified_pixel(left, found->left, found->camera, seen.left[i]);
            const Vector<2> b = rectified_pixel(right, found->right, found->camera, seen.right[i]);
            rows.add(plain(a[1 - axis] - b[1 - axis]));
            const double z = seen.places[i][2];
            const auto off = [&](const Vector<3>& at) {
                return std::hypot(plain(at[0]) - seen.places[i][0], plain(at[1]) - seen.places[i][1],
                                  plain(at[2]) - z) /
                       z;
            };
            const auto middle = eyes.midpoint(vector_of<Real>(seen.left[i]), vector_of<Real>(seen.right[i]));
            const auto best = eyes.optimal(vector_of<Real>(seen.left[i]), vector_of<Real>(seen.right[i]));
            const Result<Vector<3>> deep = found->place(a, a[axis] - b[axis]);
            if (!middle || !best || !deep) {
                ++failures;
                continue;
            }
            midpoint.add(off(middle->place));
            optimal.add(off(best->place));
            disparity.add(off(found->left.transposed() * *deep));
        }
    }

    void from_rays(const StereoCamera<>& cameras, const SeenPlaces& seen, Random& random) {
        const auto count = static_cast<std::ptrdiff_t>(seen.left.size());
        std::vector<Vector<2>> left(seen.left.size());
        std::vector<Vector<2>> right(seen.left.size());
        const Span<Vector<2>> a(left.data(), count);
        const Span<Vector<2>> b(right.data(), count);
        if (rays_of(LensInverse<>(cameras.left), seen.left_span(), a) != Status::ok ||
            rays_of(LensInverse<>(cameras.right), seen.right_span(), b) != Status::ok) {
            ++failures;
            return;
        }
        for (std::ptrdiff_t i = 0; i < count; i += 4) {
            const int x = random.between(-400, 400);
            const int y = random.between(-300, 300);
            b[i] = Vector<2>(Real::from_int(x, -10), Real::from_int(y, -10));
        }
        std::vector<std::uint8_t> agrees(seen.left.size());
        const Span<std::uint8_t> flags(agrees.data(), count);
        const auto e = fit_essential_ransac(Span<const Vector<2>>(a), Span<const Vector<2>>(b),
                                            Real::from_ratio(1, 600), {}, flags);
        if (!e) {
            ++failures;
            return;
        }
        std::vector<Vector<2>> good_left;
        std::vector<Vector<2>> good_right;
        for (std::ptrdiff_t i = 0; i < count; ++i)
            if (flags[i] != 0) {
                good_left.push_back(a[i]);
                good_right.push_back(b[i]);
            }
        const auto size = static_cast<std::ptrdiff_t>(good_left.size());
        const auto pose = recover_pose(e->transform, Span<const Vector<2>>(good_left.data(), size),
                                       Span<const Vector<2>>(good_right.data(), size));
        if (!pose) {
            ++failures;
            return;
        }
        const Pose<>& truth = cameras.right_from_left;
        const Matrix<3, 3> rest = pose->right_from_left.rotation * truth.rotation.transposed();
        constexpr double degrees = 57.29577951308232;
        turn.add(degrees * std::sqrt(std::pow(plain(rest(2, 1)), 2) + std::pow(plain(rest(0, 2)), 2) +
                                     std::pow(plain(rest(1, 0)), 2)));
        baseline.add(degrees * plain(length_of(cross(pose->right_from_left.translation,
                                                     *normalized(truth.translation)))));
    }

    void from_pixels(const StereoCamera<>& cameras, SeenPlaces seen, Random& random) {
        const auto count = static_cast<std::ptrdiff_t>(seen.left.size());
        const std::vector<SubPixelPoint> truth = seen.right;
        for (std::size_t i = 0; i < truth.size(); i += 3) {
            const int x = random.between(0, 639);
            const int y = random.between(0, 479);
            seen.right[i] = pixel_near(x, y);
        }
        std::vector<std::uint8_t> agrees(truth.size());
        const Span<std::uint8_t> flags(agrees.data(), count);
        const auto f =
            fit_fundamental_ransac(seen.left_span(), seen.right_span(), SubPixel::from_int(1), {}, flags);
        if (!f) {
            ++failures;
            return;
        }
        uncertain += f->certain ? 0 : 1;
        SeenPlaces good;
        for (std::size_t i = 0; i < truth.size(); ++i) {
            if (agrees[i] != 0) {
                good.left.push_back(seen.left[i]);
                good.right.push_back(seen.right[i]);
            }
            agreeing += i % 3 != 0 && agrees[i] != 0 ? 1 : 0;
            wrong += i % 3 == 0 && agrees[i] != 0 ? 1 : 0;
            // Places without noise, from the lines of the fit.
            const Vector<3> place(real_of(seen.places[i][0]), real_of(seen.places[i][1]),
                                  real_of(seen.places[i][2]));
            const Vector<2> left = *project(cameras.left, place);
            const Vector<2> right = *project(cameras.right, cameras.right_from_left, place);
            const auto line = epipolar_line(f->transform, left);
            if (line) epipolar.add(plain(distance_from_line(*line, right)));
        }
        const auto homographies =
            rectify_uncalibrated(f->transform, good.left_span(), good.right_span(), Size{640, 480});
        if (!homographies) {
            ++failures;
            return;
        }
        const int axis = homographies->axis == StereoAxis::x ? 0 : 1;
        for (std::size_t i = 0; i < good.left.size(); ++i) {
            const auto a = map_point(homographies->left, vector_of<Real>(good.left[i]));
            const auto b = map_point(homographies->right, vector_of<Real>(good.right[i]));
            if (!a || !b)
                ++failures;
            else
                uncalibrated.add(plain((*a)[1 - axis] - (*b)[1 - axis]));
        }
    }
};

void print_noise() {
    constexpr double noises[] = {0, 0.2, 0.5};
    Study studies[3];
    for (int k = 0; k < 3; ++k) {
        Random random(2026);
        for (int i = 0; i < 200; ++i) studies[k].one_rig(random, noises[k], i);
    }
    std::printf("| root of the mean square, largest | noise 0 | 0.2 px | 0.5 px |\n|---|---|---|---|\n");
    const struct {
        const char* name;
        Errors Study::*errors;
    } rows[] = {{"rectified rows, px", &Study::rows},
                {"place, `midpoint`, of its depth", &Study::midpoint},
                {"place, `optimal`, of its depth", &Study::optimal},
                {"place, by disparity, of its depth", &Study::disparity},
                {"turn of `recover_pose`, degrees", &Study::turn},
                {"its direction of the baseline, degrees", &Study::baseline},
                {"lines of `fit_fundamental_ransac` from pixels without noise, px", &Study::epipolar},
                {"rows of `rectify_uncalibrated`, px", &Study::uncalibrated}};
    for (const auto& row : rows) {
        std::printf("| %s |", row.name);
        for (const Study& study : studies) (study.*row.errors).print();
        std::printf("\n");
    }
    const auto counts = [&](const char* name, auto count) {
        std::printf("| %s |", name);
        for (const Study& study : studies) std::printf(" %g |", count(study));
        std::printf("\n");
    };
    counts("right pairs that agree, %", [](const Study& study) { return study.agreeing / 132.0; });
    counts("wrong pairs that agree by chance, %", [](const Study& study) { return study.wrong / 68.0; });
    counts("not `certain`, of 200", [](const Study& study) { return 1.0 * study.uncertain; });
    counts("failures, of 200", [](const Study& study) { return 1.0 * study.failures; });
}

void print_digits() {
    Random random(7);
    double f = 0, rotations = 0, fitted = 0, places = 0, optimal = 0, gap = 0;
    for (int i = 0; i < 200; ++i) {
        const RandomRig rig(random, i % 4 == 3 ? RandomRig::Kind::one_above : RandomRig::Kind::side_by_side,
                            false);
        const StereoCamera<> cameras = rig.cameras<Real>();
        const StereoCamera<Quad> same = rig.cameras<Quad>();
        f = std::max(f, apart(*fundamental_matrix(cameras), *fundamental_matrix(same)));
        const Result<Rectification<>> found = rectify(cameras, Size{640, 480});
        const auto exact = rectify(same, Size{640, 480});
        rotations = std::max({rotations, apart(found->left, exact->left), apart(found->right, exact->right)});
        const SeenPlaces seen = look_at(rig.cameras<double>(), random, 50, 0.2);
        const auto ours = fit_fundamental(seen.left_span(), seen.right_span());
        const auto theirs = fit_fundamental<Quad>(seen.left_span(), seen.right_span());
        const Triangulator<> eyes(cameras);
        const Triangulator<Quad> others(same);
        for (std::size_t k = 0; k < seen.left.size(); ++k) {
            if (ours && theirs) {
                const Real a = distance_from_line(*epipolar_line(*ours, vector_of<Real>(seen.left[k])),
                                                  vector_of<Real>(seen.right[k]));
                const Quad b = distance_from_line(*epipolar_line(*theirs, vector_of<Quad>(seen.left[k])),
                                                  vector_of<Quad>(seen.right[k]));
                fitted = std::max(fitted, std::min(apart(a, b), apart(-a, b)));
            }
            const auto middle = eyes.midpoint(vector_of<Real>(seen.left[k]), vector_of<Real>(seen.right[k]));
            const auto other = others.midpoint(vector_of<Quad>(seen.left[k]), vector_of<Quad>(seen.right[k]));
            places = std::max(places, apart(middle->place, other->place) / seen.places[k][2]);
            const auto best = eyes.optimal(vector_of<Real>(seen.left[k]), vector_of<Real>(seen.right[k]));
            const auto rest = others.optimal(vector_of<Quad>(seen.left[k]), vector_of<Quad>(seen.right[k]));
            optimal = std::max(optimal, apart(best->place, rest->place) / seen.places[k][2]);
            gap = std::max(gap, apart(best->gap, rest->gap));
        }
    }
    std::printf("\n| Real beside 113 digits, 200 pairs | largest difference |\n|---|---|\n");
    std::printf("| elements of `fundamental_matrix` | %.1g |\n", f);
    std::printf("| rotations of `rectify` | %.1g |\n", rotations);
    std::printf("| `fit_fundamental`, 50 pairs: distances from lines, px | %.1g |\n", fitted);
    std::printf("| `midpoint`, of the depth | %.1g |\n", places);
    std::printf("| `optimal`, of the depth | %.1g |\n", optimal);
    std::printf("| its gap, px | %.1g |\n", gap);
}

}  // namespace

int main() {
    print_noise();
    print_digits();
    return 0;
}
