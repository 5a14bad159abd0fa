// SPDX-License-Identifier: MIT
//
// Walks over the few pixels of an edge image that are not 0.
#pragma once

#include <cstdint>
#include <cstring>

#include <fovea/image/image_view.hpp>

namespace fovea {

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Calls visit(x, y) for every pixel that is not 0, row by row.
template <class Visit>
inline void for_each_edge(ImageView<const Gray8> edges, Visit visit) {
    const int width = edges.width();
    for (int y = 0; y < edges.height(); ++y) {
        const Gray8* row = edges.row(y);
        int x = 0;
        for (; x + 8 <= width; x += 8) {
            std::uint64_t eight = 0;
            std::memcpy(&eight, row + x, sizeof eight);
            if (eight == 0) continue;
            for (int i = x; i < x + 8; ++i)
                if (row[i] != 0) visit(i, y);
        }
        for (; x < width; ++x)
            if (row[x] != 0) visit(x, y);
    }
}

}  // namespace detail

}  // namespace fovea
