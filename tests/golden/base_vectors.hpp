// SPDX-License-Identifier: MIT
//
// Golden vectors of base/ and number/.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>

#include <fovea/base/arena.hpp>
#include <fovea/base/crc32.hpp>
#include <fovea/base/list.hpp>
#include <fovea/base/order.hpp>
#include <fovea/base/random.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/number/angle.hpp>
#include <fovea/number/decimal.hpp>
#include <fovea/number/fixed.hpp>
#include <fovea/number/int128.hpp>
#include <fovea/number/integer.hpp>
#include <fovea/number/trigonometry.hpp>
#include <golden/digest.hpp>
#include <golden/workspace.hpp>

namespace fovea::golden {

inline void put(Digest& digest, UnitVector vector) { digest.add(vector.x, vector.y); }

/// Random numbers of every length, with both signs. Here and in every vector, one expression has one side
/// effect: compilers evaluate arguments in the order they like.
inline std::int64_t wide_random(Random& random) {
    const std::uint64_t high = random.next();
    const std::uint64_t bits = high << 32 | random.next();
    return static_cast<std::int64_t>(bits) >> random.below(64);
}
inline std::int32_t narrow_random(Random& random) {
    const auto bits = static_cast<std::int32_t>(random.next());
    return bits >> random.below(32);
}

// ---- base ---------------------------------------------------------------------------------

inline void base_crc32(Workspace& work, Digest& digest) {
    constexpr std::uint8_t check[] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};
    digest.add(crc32(check));
    Random random(1);
    const Span<std::uint8_t> bytes = work.scratch_span().first(1000);
    for (std::uint8_t& byte : bytes) byte = random_byte(random);
    Crc32 pieces;
    pieces.add(bytes.first(333));
    pieces.add(bytes[333]);
    pieces.add(bytes.from(334));
    digest.add(pieces.value(), crc32(bytes), crc32({}));
}

inline void base_random(Workspace&, Digest& digest) {
    Random random(42);
    Random other(42, 54);
    for (int i = 1; i <= 100; ++i) {
        digest.add(random.next(), other.next());
        digest.add(random.below(static_cast<std::uint32_t>(i)));
        digest.add(random.between(-i, i * i));
        digest.add(random.between(std::numeric_limits<int>::min(), std::numeric_limits<int>::max() - 1));
    }
    for (int i = 4; i <= 20; ++i) {
        std::ptrdiff_t chosen[4] = {};
        draw_different(random, i, chosen);
        for (const std::ptrdiff_t number : chosen) digest.add(number);
    }
}

inline void base_order(Workspace&, Digest& digest) {
    Random random(3);
    int numbers[101] = {};
    for (int size = 1; size <= 101; size += 5)
        for (const int bound : {2, 10, 1000000}) {
            const Span<int> some = Span<int>(numbers).first(size);
            const auto refill = [&] {
                for (int& number : some) number = random.between(-bound, bound);
            };
            refill();
            digest.add(nth_smallest(some, size / 3), some);
            digest.add(median(some), some);
            refill();
            sort(some);
            digest.add(some);
            sort(some, [](int a, int b) { return a % 10 != b % 10 ? a % 10 < b % 10 : b < a; });
            swap_values(some[0], some[size - 1]);
            digest.add(some);
        }
}

inline void base_nearly_ordered(Workspace&, Digest& digest) {
    Random random(4);
    int numbers[200] = {};
    for (const int spread : {0, 3, 20, 1000}) {
        int place = 0;
        for (int& number : numbers) number = 1000 * place++ + 1000 * random.between(-spread, spread);
        sort_nearly_ordered(Span<int>(numbers), [](int a, int b) { return a < b; });
        digest.add(Span<const int>(numbers));
    }
}

inline void base_containers(Workspace& work, Digest& digest) {
    Arena arena(work.scratch_span().first(100));
    const Span<std::uint8_t> bytes = arena.take<std::uint8_t>(3);
    const Span<std::uint32_t> words = arena.take<std::uint32_t>(4);
    digest.add(bytes, words, arena.rest().size(), arena_bytes<std::uint16_t>(5));
    List<int, 3> list;
    digest.add(list.view().capacity(), list.begin() == list.end());
    for (int i = 0; i < 5; ++i) digest.add(list.push(i * i), list.view());
    list.view().shrink(1);
    *list.view().append() = 7;
    digest.add(list.view().full(), list.empty(), list.view());
    for (int status = 0; status <= static_cast<int>(Status::io_error); ++status)
        put_text(digest, describe(static_cast<Status>(status)));
}

// ---- number -------------------------------------------------------------------------------

inline void number_integer(Workspace&, Digest& digest) {
    Random random(5);
    for (int i = 0; i < 300; ++i) {
        const std::int64_t a = wide_random(random);
        const std::int64_t b = wide_random(random);
        const std::int32_t c = narrow_random(random);
        const std::int32_t d = narrow_random(random);
        const auto positive = static_cast<std::int32_t>(magnitude(d) >> 1) + 1;
        digest.add(minimum(a, b), maximum(a, b), clamp(a, -std::int64_t{positive}, std::int64_t{positive}));
        digest.add(magnitude(a), magnitude(c), multiply_high(c, d));
        digest.add(saturate_cast<std::int8_t>(a), saturate_cast<std::uint8_t>(a),
                   saturate_cast<std::int16_t>(a), saturate_cast<std::uint16_t>(c),
                   saturate_cast<std::int32_t>(a), saturate_cast<std::uint32_t>(a));
        digest.add(round_shift(a >> 1, i % 60), round_shift(c >> 1, i % 30), floor_divide(c, positive),
                   floor_modulo(c, positive), round_divide(c >> 1, positive),
                   round_divide<std::int64_t>(a >> 1, positive));
        digest.add(leading_zeros(magnitude(a)), leading_zeros(magnitude(c)));
        digest.add(trailing_zeros(magnitude(a) | std::uint64_t{1} << i % 64),
                   trailing_zeros(magnitude(c) | std::uint32_t{1} << i % 32));
    }
}

inline void number_root(Workspace&, Digest& digest) {
    Random random(6);
    for (std::uint32_t i = 0; i < 70; ++i)
        digest.add(isqrt(i), isqrt(std::uint64_t{i} * i - (i > 0 ? 1 : 0)));
    digest.add(isqrt(~std::uint32_t{0}), isqrt(~std::uint64_t{0}));
    for (int i = 0; i < 300; ++i) {
        const std::int64_t a = wide_random(random);
        const std::int64_t b = wide_random(random);
        digest.add(isqrt(magnitude(narrow_random(random))), isqrt(magnitude(a)), hypotenuse(a >> 2, b >> 2));
    }
}

inline void number_int128(Workspace&, Digest& digest) {
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const std::int64_t a = wide_random(random) >> 1;
        const std::int64_t b = wide_random(random) >> 1;
        const std::int64_t c = wide_random(random) >> 1 | 1;
        const Int128 product = Int128::product(a, b);
        digest.add(Int128::product_in_words(a, b));
        const Int128 wide = (product >> 30) * (c >> 40);
        Int128 sum = product;
        sum += Int128(c);
        sum -= wide >> 70;
        digest.add(product, wide, sum, -sum, sum - product, product + wide, product << i % 2,
                   wide >> i % 128);
        digest.add(product < wide, product == wide, product != wide, sum.negative(), sum.bit_length(),
                   sum.fits_int64());
        const Int128 divisor = wide == Int128(0) ? Int128(-7) : wide >> i % 60;
        digest.add(round_divide(product, Int128(c)), round_divide(product, divisor + divisor + Int128(1)),
                   multiply_divide(a, b, c));
    }
}

inline void number_trigonometry(Workspace&, Digest& digest) {
    for (std::uint32_t raw = 0; raw < 4096; ++raw) {
        const auto angle = FineAngle::from_raw(raw * 1048583u);
        const UnitVector vector = unit_vector(angle);
        digest.add(vector, angle_of(vector.x.raw(), vector.y.raw()));
    }
    Random random(8);
    for (int i = 0; i < 300; ++i) {
        const std::int32_t x = narrow_random(random);
        digest.add(angle_of(x, narrow_random(random)), angle_of(x, x), angle_of(0, x), angle_of(-x / 2, 0));
        const std::int64_t wide = wide_random(random);
        digest.add(angle_of(wide, wide_random(random)));
    }
}

inline void number_angle(Workspace&, Digest& digest) {
    Random random(9);
    for (int degrees = -725; degrees <= 725; degrees += 29) {
        const Angle angle = Angle::from_degrees(degrees);
        digest.add(angle, angle.signed_raw(), angle + Angle::from_raw(40000), angle - Angle::from_raw(40000));
        const FineAngle fine = FineAngle::from_microdegrees(degrees * std::int64_t{1000003});
        digest.add(fine, fine.signed_raw(), fine.microdegrees(), fine.coarse(), -fine,
                   fine + FineAngle::quarter_turn(), fine - FineAngle::half_turn(), FineAngle(angle));
    }
    for (int i = 0; i < 300; ++i) {
        const auto sub_pixel = SubPixel::from_raw(narrow_random(random) >> 2);
        const auto fine = FinePixel::from_raw(narrow_random(random) >> 2);
        digest.add(fine.floor(), fine.round(), fine.convert<SubPixel>(), sub_pixel.convert<FinePixel>(),
                   sub_pixel.convert<Fixed<std::int16_t, 4>>(), fine + FinePixel::from_int(i), -fine,
                   fine - FinePixel::from_int(i), sub_pixel * -1, sub_pixel < SubPixel::from_int(i));
        digest.add(Ratio::from_ratio(narrow_random(random), i + 1), Unit::from_ratio(i - 150, 151));
    }
}

inline void number_decimal(Workspace&, Digest& digest) {
    const Span<const char> texts[] = {
        "0",         "-0.000",    "12.5", "+3",        "1000000", "1000001", "-999999.999999",
        "0.0000001", "1.2300000", "00.1", ".5",        "5.",      "",        "-",
        "1e3",       "1 ",        "--1",  "0.9999995", "123456.7"};
    char room[28] = {};
    for (const Span<const char> text : texts) {
        // Without the zero at the end of a literal.
        const Result<Decimal> number = parse_decimal(text.first(text.size() - 1));
        digest.add(number);
        if (!number) continue;
        for (int places = -1; places <= 7; ++places) {
            const Result<int> length = print_decimal(*number, places, room);
            digest.add(length);
            if (length) digest.add(Span<const char>(room).first(*length));
        }
    }
    digest.add(print_decimal(Decimal{std::numeric_limits<std::int64_t>::min()}, 3, room));
    digest.add(Span<const char>(room), print_decimal(Decimal::from_int(1), 6, Span<char>(room).first(27)));
    const Decimal one = Decimal::from_int(1);
    const Decimal half{500000};
    digest.add(one + half, one - half, -one, half<one, half> one, half <= one, half >= one, half == one);
}

}  // namespace fovea::golden
