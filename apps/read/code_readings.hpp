// SPDX-License-Identifier: MIT
//
// CodeReadings: the codes of a picture with their texts, read by a job without taking memory.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <fovea/base/list.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/code/code.hpp>
#include <fovea/code/read_codes.hpp>
#include <fovea/code/text_utf8.hpp>
#include <fovea/image/image_view.hpp>

#include <read/code_job.hpp>

namespace fovea::apps {

/// A code as it is told.
struct CodeReading {
    Code code;
    Span<const char> text;           ///< in UTF-8
    Span<const std::uint8_t> bytes;  ///< as they stand in the code
    /// One word for why it is not OK; empty if it is.
    const char* fault = "";
};

/// Scratch bytes that reading pictures of that size needs.
constexpr std::int64_t read_job_scratch(Size looked_at) { return read_codes_scratch(looked_at); }

class CodeReadings {
public:
    /// One more than can be expected, so that it is seen.
    static constexpr int most = CodeJob::most_codes + 1;
    /// Bytes of all texts of a picture in UTF-8, and as they stand in the codes: a line that tells of them
    /// has room for so many, however many letters each takes there.
    static constexpr int most_text = 768;

    CodeReadings() = default;
    CodeReadings(const CodeReadings&) = delete;
    CodeReadings& operator=(const CodeReadings&) = delete;

    /// Reads what a job looks for, from left to right; from top to bottom in what is higher than wide.
    /// keeps(symbology, text) says of which codes; others are as if they were not there.
    ///
    /// Scratch  read_job_scratch() of what the job looks at
    /// Errors   out_of_range for a picture that the job's region leaves; not_found for no code, undecided
    ///          where one was seen and lines did not agree; buffer_too_small for more text than most_text
    ///          in the codes that are kept, with none read; others as read_codes() has them
    template <class Keeps>
    Status read(ImageView<const Gray8> picture, const CodeJob& job, Span<std::uint8_t> scratch, Keeps keeps);

    Span<CodeReading> codes() { return {readings_, count_}; }
    Span<const CodeReading> codes() const { return {readings_, count_}; }
    /// How many of the codes have this text, whatever their kind.
    int times(Span<const char> text) const {
        return static_cast<int>(std::count_if(readings_, readings_ + count_, [&](const CodeReading& reading) {
            return std::equal(text.begin(), text.end(), reading.text.begin(), reading.text.end());
        }));
    }
    void clear() { count_ = 0; }

private:
    /// The longest text of one code is of 7089 digits, in QR.
    static constexpr int most_bytes = 8192;

    Status take(const CodeText& text, const Code& code, Span<std::uint8_t> utf8, CodeReading& reading);
    Status keep(CodeReading& reading);

    List<Code, CodeJob::most_seen> seen_;
    CodeReading readings_[most];
    int count_ = 0;
    std::uint8_t bytes_[most_bytes];
    std::uint8_t utf8_[most_text];
    int utf8_used_ = 0;
    int bytes_told_ = 0;
};

/// Codes that are remembered: their kinds and bytes, for what no character stands for is alike as a text.
class KnownCodes {
public:
    void clear() { count_ = 0; }
    bool empty() const { return count_ == 0; }
    void take(Span<const CodeReading> codes) {
        count_ = 0;
        int used = 0;
        for (const CodeReading& reading : codes) {
            FOVEA_ASSERT(count_ < CodeReadings::most &&
                         used + reading.bytes.size() <= CodeReadings::most_text);
            std::copy(reading.bytes.begin(), reading.bytes.end(), bytes_ + used);
            known_[count_++] = {reading.code.symbology, used, static_cast<int>(reading.bytes.size())};
            used += static_cast<int>(reading.bytes.size());
        }
    }
    bool contains(const CodeReading& reading) const {
        for (int k = 0; k < count_; ++k) {
            const std::uint8_t* const first = bytes_ + known_[k].first;
            if (known_[k].symbology == reading.code.symbology &&
                std::equal(reading.bytes.begin(), reading.bytes.end(), first, first + known_[k].size))
                return true;
        }
        return false;
    }

private:
    struct Known {
        Symbology symbology;
        int first;
        int size;
    };

    Known known_[CodeReadings::most];
    int count_ = 0;
    std::uint8_t bytes_[CodeReadings::most_text];
};

// ---- Implementation ---------------------------------------------------------------

namespace detail {

/// Four times the place of its middle along x or y, in 1/256 px.
inline std::int64_t place_along(const Code& code, bool down) {
    std::int64_t sum = 0;
    for (const SubPixelPoint& corner : code.corners) sum += (down ? corner.y : corner.x).raw();
    return sum;
}

}  // namespace detail

/// The code with its text, which lies in utf8. A picture in which a text has room needs more scratch than it.
inline Status CodeReadings::take(const CodeText& text, const Code& code, Span<std::uint8_t> utf8,
                                 CodeReading& reading) {
    reading = {code, {}, text.bytes().from(code.text_first).first(code.text_size), ""};
    Result<int> size = text_utf8(text, code.text_first, code.text_size, utf8);
    if (size.status() == Status::unsupported) {
        // As if no interpretation were stated. The bytes go where they are already.
        CodeText plain({bytes_ + code.text_first, code.text_size});
        for (const std::uint8_t byte : reading.bytes) static_cast<void>(plain.push(byte));
        size = text_utf8(plain, 0, plain.size(), utf8);
    }
    if (!size) return size.status();
    reading.text = {reinterpret_cast<const char*>(utf8.data()), *size};
    return Status::ok;
}

/// Copies the text of a code to those of the others.
inline Status CodeReadings::keep(CodeReading& reading) {
    if (reading.text.size() > most_text - utf8_used_ || reading.bytes.size() > most_text - bytes_told_)
        return Status::buffer_too_small;
    std::uint8_t* const own = utf8_ + utf8_used_;
    std::copy(reading.text.begin(), reading.text.end(), own);
    reading.text = {reinterpret_cast<const char*>(own), reading.text.size()};
    utf8_used_ += static_cast<int>(reading.text.size());
    bytes_told_ += static_cast<int>(reading.bytes.size());
    return Status::ok;
}

template <class Keeps>
Status CodeReadings::read(ImageView<const Gray8> picture, const CodeJob& job, Span<std::uint8_t> scratch,
                          Keeps keeps) {
    count_ = utf8_used_ = bytes_told_ = 0;
    seen_.clear();
    if (!job.inside(picture.size())) return Status::out_of_range;
    const Rectangle all{0, 0, picture.width(), picture.height()};
    const Rectangle area = job.region.empty() ? all : job.region;
    const Result<ImageView<const Gray8>> part = picture.crop(area);
    if (!part) return part.status();
    CodeText text({bytes_, most_bytes});
    const Status status = read_codes(*part, job.options, scratch, text, seen_);
    if (status != Status::ok) return status;
    const bool down = area.height > area.width;
    // Of 32 at most, and nothing that takes memory.
    for (int k = 1; k < seen_.size(); ++k)
        for (int i = k;
             i > 0 && detail::place_along(seen_[i], down) < detail::place_along(seen_[i - 1], down); --i)
            std::swap(seen_[i], seen_[i - 1]);
    for (Code& code : seen_) {
        for (SubPixelPoint& corner : code.corners)
            corner = {corner.x + SubPixel::from_int(area.x), corner.y + SubPixel::from_int(area.y)};
        if (count_ == most) break;
        // All that was to be seen has been read, so its scratch is free.
        CodeReading& reading = readings_[count_];
        Status taken = take(text, code, scratch, reading);
        if (taken == Status::ok && !keeps(reading)) continue;
        if (taken == Status::ok) taken = keep(reading);
        if (taken != Status::ok) return count_ = 0, taken;
        ++count_;
    }
    return count_ == 0 ? Status::not_found : Status::ok;
}

}  // namespace fovea::apps
