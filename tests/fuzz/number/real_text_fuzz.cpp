// SPDX-License-Identifier: MIT
//
// Any bytes as a number: the reader ends, what it reads is a number, and that is the same again when it is
// written and read.
#include <cstddef>
#include <cstdint>

#include <fovea/number/real_text.hpp>

namespace {

using namespace fovea;

void require(bool claim) {
    if (!claim) __builtin_trap();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Span<const char> text(reinterpret_cast<const char*>(data), static_cast<std::ptrdiff_t>(size));
    const Result<Real> number = parse_real(text);
    if (!number) return 0;
    require(number->zero() ? *number == Real() : number->mantissa() >> 63 != 0);
    for (int digits = 1; digits <= whole_real_digits; ++digits) {
        char buffer[8 + whole_real_digits];
        const Span<char> room(buffer, 8 + digits);
        const Result<int> length = print_real(*number, digits, room);
        require(length.ok() || length.status() == Status::out_of_range);
        if (!length) continue;
        require(*length > 0 && *length <= room.size());
        const Result<Real> again = parse_real(Span<const char>(buffer, *length));
        require(again.ok());
        if (digits == whole_real_digits) require(*again == *number);
    }
    return 0;
}
