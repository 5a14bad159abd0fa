// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include <fovea/codec/inflate.hpp>

#include "lossless_files.hpp"

namespace fovea::test {

struct Inflated {
    Status status = Status::ok;
    Bytes data;
};

/// Raw deflate data, up to `most` bytes of them.
inline Inflated inflate_raw(const Bytes& bytes, std::size_t most = 100000) {
    Bytes scratch = zeros(inflate_scratch());
    OnePiece source(view_of(bytes));
    Inflater<OnePiece> inflater(source, room_in(scratch));
    Inflated result{Status::ok, Bytes(most)};
    const Result<std::ptrdiff_t> read = inflater.read(room_in(result.data));
    result.status = read.status();
    result.data.resize(read ? static_cast<std::size_t>(*read) : 0);
    return result;
}

inline Inflated inflate_whole(const Bytes& bytes, std::size_t most = 100000) {
    Bytes scratch = zeros(inflate_scratch());
    Inflated result{Status::ok, Bytes(most)};
    const Result<std::ptrdiff_t> read = inflate_zlib(view_of(bytes), room_in(scratch), room_in(result.data));
    result.status = read.status();
    result.data.resize(read ? static_cast<std::size_t>(*read) : 0);
    return result;
}

}  // namespace fovea::test
