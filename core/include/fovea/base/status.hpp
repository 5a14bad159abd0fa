// SPDX-License-Identifier: MIT
//
// Status and Result: how every operator says whether it did its work.
#pragma once

#include <cstdint>

#include <fovea/base/assert.hpp>

namespace fovea {

/// What became of a call. Checks run in the order of this list: empty, size, arguments, scratch; then the
/// work.
enum class [[nodiscard]] Status : std::uint8_t{
    ok,
    empty_image,        ///< a view without pixels
    size_mismatch,      ///< views that must agree in size do not
    image_too_large,    ///< larger than the stated bound of the operator
    bad_argument,       ///< a parameter outside its stated range
    out_of_range,       ///< a place outside the image or the sequence
    misaligned,         ///< foreign memory does not fit the pixel's alignment
    scratch_too_small,  ///< less scratch than <operator>_scratch() asks for
    buffer_too_small,   ///< the output does not fit its buffer
    capacity_exceeded,  ///< a list is full; it holds the strongest entries
    not_found,          ///< nothing there: a result, not a fault
    undecided,          ///< an answer exists but is not certain enough to give
    degenerate,         ///< the data do not determine the answer (one point for a line, three for no circle)
    truncated,          ///< foreign bytes end too early
    malformed,          ///< foreign bytes contradict their format
    unsupported,        ///< a valid format or variant that this library does not read
    io_error,           ///< the system refused; ports tell more
    irregular,          ///< there is something, of another shape than what is measured
    timeout,            ///< nothing came within the patience given: ask again
    no_signal,          ///< the device is there and its sensor is silent
    device_lost,        ///< the device is gone: open it again
};

/// One lower-case phrase for messages, without a full stop.
constexpr const char* describe(Status status) {
    switch (status) {
        case Status::ok: return "ok";
        case Status::empty_image: return "the image is empty";
        case Status::size_mismatch: return "image sizes do not agree";
        case Status::image_too_large: return "the image is too large";
        case Status::bad_argument: return "a parameter is out of its range";
        case Status::out_of_range: return "a place lies outside the image";
        case Status::misaligned: return "memory is not aligned to the pixel";
        case Status::scratch_too_small: return "scratch memory is too small";
        case Status::buffer_too_small: return "the output buffer is too small";
        case Status::capacity_exceeded: return "more entries than the list can hold";
        case Status::not_found: return "nothing found";
        case Status::undecided: return "undecided";
        case Status::degenerate: return "the data do not determine an answer";
        case Status::truncated: return "the data end too early";
        case Status::malformed: return "the data contradict their format";
        case Status::unsupported: return "this variant of the format is not supported";
        case Status::io_error: return "the system refused the operation";
        case Status::irregular: return "not of the shape that is measured";
        case Status::timeout: return "nothing came in time";
        case Status::no_signal: return "the sensor gives no signal";
        case Status::device_lost: return "the device is gone";
    }
    return "unknown status";
}

/// A small answer or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
public:
    constexpr Result(const T& value) : value_(value), status_(Status::ok) {}
    constexpr Result(Status status) : status_(status) { FOVEA_ASSERT(status != Status::ok); }

    constexpr bool ok() const { return status_ == Status::ok; }
    constexpr explicit operator bool() const { return ok(); }
    constexpr Status status() const { return status_; }

    /// The answer; asking for it without one is our own mistake.
    constexpr const T& value() const {
        FOVEA_ASSERT(ok());
        return value_;
    }
    constexpr const T& operator*() const { return value(); }
    constexpr const T* operator->() const { return &value(); }

private:
    T value_{};
    Status status_;
};

}  // namespace fovea
