// SPDX-License-Identifier: MIT
//
// Order statistics: sorting and the k-th smallest element, in bounded time and without recursion.
#pragma once

#include <cstddef>

#include <fovea/base/assert.hpp>
#include <fovea/base/span.hpp>

namespace fovea {

// ---- Interface --------------------------------------------------------------------

/// Exchanges two values.
template <class T>
constexpr void swap_values(T& a, T& b) {
    const T old = a;
    a = b;
    b = old;
}

/// Sorts by less(a, b), in place. Elements that compare equal may change places: add an index to the order
/// where that matters.
///
/// Cost    n log n comparisons at most 2 n log2 n, whatever the input; no memory
/// Source  Williams, "Algorithm 232: Heapsort", CACM 7(6), 1964
template <class T, class Less>
constexpr void sort(Span<T> elements, Less less);

/// Sorts ascending by <.
template <class T>
constexpr void sort(Span<T> elements);

/// The same for elements most of which are near their places already, such as what a scan finds row by row.
///
/// Cost    n^1.5 comparisons at most, few more than n for each power of three in n where little is to be
///         moved; no memory
/// Source  Shell, "A High-Speed Sorting Procedure", CACM 2(7), 1959; gaps after Knuth, "The Art of Computer
///         Programming", vol. 3, sec. 5.2.1
template <class T, class Less>
constexpr void sort_nearly_ordered(Span<T> elements, Less less);

/// Moves the k-th smallest element (k from 0) to place k, with none larger before and none smaller behind it.
///
/// Cost    n comparisons on average; 8 n at most, after which the rest is sorted
/// Source  Hoare, "Algorithm 65: FIND", CACM 4(7), 1961, with the middle element as pivot
template <class T>
constexpr T& nth_smallest(Span<T> elements, std::ptrdiff_t k);

/// The middle element, of an even count the lower one of the two. Reorders the elements; there must be one.
template <class T>
constexpr T median(Span<T> elements) {
    FOVEA_ASSERT(!elements.empty());
    return nth_smallest(elements, (elements.size() - 1) / 2);
}

// ---- Implementation ---------------------------------------------------------------

namespace detail {

template <class T, class Less>
constexpr void sift_down(Span<T> heap, std::ptrdiff_t start, std::ptrdiff_t size, Less less) {
    std::ptrdiff_t parent = start;
    for (std::ptrdiff_t child = 2 * parent + 1; child < size; child = 2 * parent + 1) {
        if (child + 1 < size && less(heap[child], heap[child + 1])) ++child;
        if (!less(heap[parent], heap[child])) return;
        swap_values(heap[parent], heap[child]);
        parent = child;
    }
}

}  // namespace detail

template <class T, class Less>
constexpr void sort(Span<T> elements, Less less) {
    for (std::ptrdiff_t start = elements.size() / 2 - 1; start >= 0; --start)
        detail::sift_down(elements, start, elements.size(), less);
    for (std::ptrdiff_t size = elements.size() - 1; size > 0; --size) {
        swap_values(elements[0], elements[size]);
        detail::sift_down(elements, 0, size, less);
    }
}

template <class T>
constexpr void sort(Span<T> elements) {
    sort(elements, [](const T& a, const T& b) { return a < b; });
}

template <class T, class Less>
constexpr void sort_nearly_ordered(Span<T> elements, Less less) {
    std::ptrdiff_t gap = 1;
    while (gap < elements.size() / 3) gap = 3 * gap + 1;
    for (; gap > 0; gap /= 3)
        for (std::ptrdiff_t i = gap; i < elements.size(); ++i) {
            if (!less(elements[i], elements[i - gap])) continue;
            const T moved = elements[i];
            std::ptrdiff_t place = i;
            for (; place >= gap && less(moved, elements[place - gap]); place -= gap)
                elements[place] = elements[place - gap];
            elements[place] = moved;
        }
}

template <class T>
constexpr T& nth_smallest(Span<T> elements, std::ptrdiff_t k) {
    FOVEA_ASSERT(k >= 0 && k < elements.size());
    std::ptrdiff_t low = 0;
    std::ptrdiff_t high = elements.size() - 1;
    std::ptrdiff_t steps_left = 8 * elements.size();
    while (low < high) {
        if (steps_left <= 0) {
            sort(elements.from(low).first(high - low + 1));
            break;
        }
        steps_left -= high - low + 1;
        const T pivot = elements[low + (high - low) / 2];
        std::ptrdiff_t i = low;
        std::ptrdiff_t j = high;
        while (i <= j) {
            while (elements[i] < pivot) ++i;
            while (pivot < elements[j]) --j;
            if (i > j) break;
            swap_values(elements[i++], elements[j--]);
        }
        if (k <= j)
            high = j;
        else if (k >= i)
            low = i;
        else
            break;
    }
    return elements[k];
}

}  // namespace fovea
