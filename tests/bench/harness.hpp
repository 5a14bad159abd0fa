// SPDX-License-Identifier: MIT
//
// Times operators against memcpy of the bytes that they must move and against what others offer, all in one
// process.
//
// The columns of a row are interleaved round by round, so that what disturbs the machine disturbs them alike.
// A sample is an untimed call, which brings the column's memory into the cache, and then a batch of calls.
// What is reported is the median; what counts is the ratio of two medians of the same run.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fovea/image/geometry.hpp>

namespace fovea::bench {

/// One way to do the work of a row.
struct Column {
    std::string name;
    std::function<void()> run;
    double nanoseconds = 0;  ///< median of a call
};

/// An operator on an image of one size. The set-up function of a case fills it.
class Row {
public:
    explicit Row(Size size) : size_(size) {}

    Size size() const { return size_; }
    /// The operator of fovea.
    void ours(std::function<void()> run) { columns_.push_back({"fovea", std::move(run)}); }
    /// The same by a library that others use.
    void peer(const std::string& name, std::function<void()> run) {
        columns_.push_back({name, std::move(run)});
    }
    /// Keeps what the functions refer to alive as long as the row.
    template <class T>
    T& keep(T value) {
        auto owner = std::make_shared<T>(std::move(value));
        owners_.push_back(owner);
        return *owner;
    }
    /// Bytes that the operator reads and writes at least. Without this: a gray frame, read and written.
    void moves(std::int64_t bytes) { moved_bytes_ = bytes; }
    /// The work does not grow with the image, so figures per pixel would say nothing.
    void not_per_pixel() { per_pixel_ = false; }
    /// Said beside the figures.
    void remark(const std::string& text) { remark_ = text; }

    std::int64_t moved_bytes() const { return moved_bytes_ > 0 ? moved_bytes_ : 2 * size_.area(); }
    bool per_pixel() const { return per_pixel_; }
    const std::string& remark() const { return remark_; }
    std::vector<Column>& columns() { return columns_; }

private:
    Size size_;
    std::int64_t moved_bytes_ = 0;
    bool per_pixel_ = true;
    std::string remark_;
    std::vector<Column> columns_;
    std::vector<std::shared_ptr<void>> owners_;
};

using SetUp = std::function<void(Row&)>;

/// Which sizes a case is run at if none are asked for. Cases of the cost against the window are run at VGA
/// and stand in a table of their own.
enum class Sizes { vga, vga_and_full_hd, windows };

/// Adds a case, before main() begins. order sorts the rows of the page.
bool add(int order, const std::string& name, Sizes sizes, SetUp set_up);

/// Takes a value, so that the compiler must compute it.
template <class T>
void consume(const T& value) {
    asm volatile("" : : "r"(&value) : "memory");
}

}  // namespace fovea::bench
