// SPDX-License-Identifier: MIT
//
// What numbers and geometry cost a chip.
//   =1 NAME    a cost of one count, over as many calls as the page of instructions says
#include <cstdint>

#include <board.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/camera/camera.hpp>
#include <fovea/camera/lens_inverse.hpp>
#include <fovea/linear/cholesky.hpp>
#include <fovea/linear/eigen.hpp>
#include <fovea/linear/svd.hpp>
#include <fovea/match/fit_homography.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/real.hpp>
#include <fovea/number/trigonometry.hpp>

#include <target/print.hpp>

extern "C" {
[[gnu::noinline]] void fovea_region_begin() { __asm volatile(""); }
[[gnu::noinline]] void fovea_region_end() { __asm volatile(""); }
}

using namespace fovea;

/// Operands as geometry has them: both signs, sizes within a few powers of two. Not of this file alone, so
/// that the compiler keeps results that nothing reads.
inline constexpr int operands = 256;
Real left[operands];
Real right[operands];
Real results[operands];
std::uint32_t words[operands];

namespace {

Real random_real(Random& random) {
    const std::uint64_t high = random.next();
    return Real::from_int(static_cast<std::int64_t>(high << 32 | random.next()), random.between(-66, -60));
}

/// run(i) for every operand between the marks.
template <class Run>
void count(Run run) {
    fovea_region_begin();
    for (int i = 0; i < operands; ++i) run(i);
    __asm volatile("" ::: "memory");
    fovea_region_end();
}
template <class Run>
void count_once(Run run) {
    fovea_region_begin();
    run();
    fovea_region_end();
}
}  // namespace

int main() {
    auto serial = board::start_serial();
    const auto tell = [&](const char* name) {
        target::print(serial, "=1 ");
        target::print(serial, name);
        target::print(serial, "\n");
    };
    Random random(5);
    for (int i = 0; i < operands; ++i) {
        left[i] = random_real(random);
        right[i] = random_real(random);
        words[i] = random.next();
    }

    count([](int i) { results[i] = left[i] * right[i]; });
    tell("Real: product");
    count([](int i) { results[i] = left[i] + right[i]; });
    tell("Real: sum");
    count([](int i) { results[i] = left[i] / right[i]; });
    tell("Real: quotient");
    count([](int i) { results[i] = left[i].square_root(); });
    tell("Real: root");
    count([](int i) { results[i] = left[i] < right[i] ? left[i] : right[i]; });
    tell("Real: comparison");
    count([](int i) { words[i] += static_cast<std::uint32_t>(left[i].rounded(16)); });
    tell("Real: to an integer");
    count([](int i) { words[i] += isqrt(words[i]); });
    tell("isqrt of 32 bits");
    count([](int i) {
        words[i] += static_cast<std::uint32_t>(unit_vector(FineAngle::from_raw(words[i])).x.raw());
    });
    tell("unit_vector");
    count([](int i) {
        words[i] +=
            angle_of(static_cast<std::int32_t>(words[i]), static_cast<std::int32_t>(words[255 - i])).raw();
    });
    tell("angle_of");

    const auto a = [&] {
        static Matrix<9, 9> matrix;
        for (int r = 0; r < 9; ++r)
            for (int c = 0; c <= r; ++c) matrix(r, c) = matrix(c, r) = random_real(random);
        return matrix;
    };
    static Matrix<9, 9> matrix;
    static Matrix<9, 9> vectors;
    static Real values[9];
    bool right_answers = true;
    const auto wanted = [&](Status status) { right_answers = right_answers && status == Status::ok; };
    {
        const Matrix<9, 9> part = a();
        matrix = part * part;
    }
    static Real b[9];
    for (Real& value : b) value = random_real(random);
    const MatrixView<Real> eight(&matrix(0, 0), 8, 8, 9);
    count_once([&] { wanted(solve_ldlt(eight, Span<Real>(b, 8))); });
    tell("solve_ldlt, 8 unknowns");
    matrix = a();
    count_once([&] { wanted(symmetric_eigen(matrix.view(), vectors.view())); });
    tell("symmetric_eigen, 9 x 9");
    matrix = a();
    const MatrixView<Real> three(&matrix(0, 0), 3, 3, 9);
    count_once([&] { wanted(svd(three, MatrixView<Real>(&vectors(0, 0), 3, 3, 9), Span<Real>(values, 3))); });
    tell("svd, 3 x 3");

    // A board of 9x6 corners, tilted.
    static PlanePoint corners[54];
    static SubPixelPoint pixels[54];
    for (int i = 0; i < 54; ++i) {
        const int x = i % 9;
        const int y = i / 9;
        const int weight = 100 + x - 2 * y;
        corners[i] = {25 * x, 25 * y};
        const int noise = random.between(-50, 50);
        pixels[i] = {SubPixel::from_raw((100 + 30 * x) * 25600 / weight + noise),
                     SubPixel::from_raw((80 + 30 * y) * 25600 / weight - noise)};
    }
    count_once([&] {
        wanted(fit_homography(Span<const PlanePoint>(corners), Span<const SubPixelPoint>(pixels)).status());
    });
    tell("fit_homography, 54 pairs");

    static const Camera<> camera = {
        Real::from_int(580),     Real::from_int(581),      Real::from_int(320),
        Real::from_int(240),     Real::from_ratio(-1, 4),  Real::from_ratio(1, 11),
        Real::from_ratio(1, 90), Real::from_ratio(1, 900), Real::from_ratio(-1, 700)};
    static Vector<2> pixel;
    count_once([&] {
        const Result<Vector<2>> seen =
            project(camera, Vector<3>(Real::from_int(-500), Real::from_int(-400), Real::from_int(1000)));
        wanted(seen.status());
        pixel = *seen;
    });
    tell("project");
    static const LensInverse<> lens(camera);
    count_once([&] { wanted(lens.ray(pixel).status()); });
    tell("LensInverse::ray, in the corner");
    return right_answers ? 0 : 1;
}
