// SPDX-License-Identifier: MIT
//
// GenerationStorage: jobs, counters and what was taught, in two files that take turns. No power cut loses
// what was saved before, on file systems without journals as well.
#pragma once

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <fovea/base/crc32.hpp>
#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/storage.hpp>
#include <fovea/linux/fault.hpp>
#include <fovea/linux/kernel.hpp>
#include <fovea/linux/replace_file.hpp>
#include <fovea/linux/text.hpp>

namespace fovea::linux_port {

// ---- Interface --------------------------------------------------------------------

/// What stands before the bytes of a generation, each in 4 bytes, the low one first: "FVGN", the version of
/// the format (1), the number of the generation, how many bytes follow, and the CRC-32 of what comes before
/// it here and of them.
struct GenerationHeader {
    std::uint32_t generation = 0;
    std::uint32_t bytes = 0;
    std::uint32_t crc = 0;
};
inline constexpr int generation_header_bytes = 20;

/// Errors  truncated, malformed for other bytes at the start, unsupported for another version
constexpr Result<GenerationHeader> parse_generation_header(Span<const std::uint8_t> file);

/// True if a follows b. Numbers begin again behind the largest.
constexpr bool is_newer_generation(std::uint32_t a, std::uint32_t b) { return a != b && a - b < 0x80000000u; }

/// Keeps the newest two generations of what has a name, a path: in NAME.a and NAME.b. It is written in
/// NAME.new first. Nobody else writes there.
template <class System = Kernel>
class GenerationStorage {
public:
    /// memory for the longest byte string, which outlives the storage.
    explicit GenerationStorage(System system, Span<std::uint8_t> memory) : system_(system), memory_(memory) {}

    /// The newest generation that is whole.
    ///
    /// Errors  not_found where nothing was ever saved; malformed where neither is whole; buffer_too_small;
    ///         io_error
    Result<Span<const std::uint8_t>> load(const char* name);

    /// Replaces the older generation, or the one that is not whole.
    ///
    /// Errors  as replace_file(); buffer_too_small for more than load() could give back; bad_argument for a
    ///         name that is too long
    Status save(const char* name, Span<const std::uint8_t> bytes);

    /// True if load() gave an older generation because the other file is damaged: it may have held the
    /// newest.
    bool fell_back() const { return fell_back_; }
    /// The number of what load() gave or save() wrote last.
    std::uint32_t generation() const { return generation_; }
    const Fault& fault() const { return fault_; }
    const char* problem() const { return fault_.call[0] == '\0' ? "" : reason(fault_); }

private:
    using Path = Text<511>;
    enum class State : std::uint8_t {
        missing,
        damaged,     ///< it does not hold what it must
        unreadable,  ///< the medium does not give it
        whole,
    };
    struct Slot {
        State state = State::missing;
        std::uint32_t generation = 0;
        std::int64_t bytes = 0;
    };

    Status fail(const char* call, int error, Status status, const char* about) {
        fault_ = {call, error, status, about};
        return status;
    }
    static Path path_of(const char* name, int slot) { return Path(name).add(slot == 0 ? ".a" : ".b"); }
    std::ptrdiff_t read_up_to(int file, Span<std::uint8_t> into);
    Status inspect(const char* path, Span<std::uint8_t> into, Slot& slot);
    State check(int file, Span<std::uint8_t> into, Slot& slot);
    Status inspect_both(const char* name, Slot (&slots)[2]);
    static int newest(const Slot (&slots)[2]);

    System system_;
    Span<std::uint8_t> memory_;
    bool fell_back_ = false;
    std::uint32_t generation_ = 0;
    Fault fault_;
};

static_assert(hal::is_storage_v<GenerationStorage<>>);

// ---- Implementation ---------------------------------------------------------------

namespace detail {

inline constexpr std::uint8_t generation_magic[4] = {'F', 'V', 'G', 'N'};
inline constexpr std::uint32_t generation_version = 1;

constexpr void put_word(std::uint32_t word, std::uint8_t* bytes) {
    for (int i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(word >> (8 * i));
}
constexpr std::uint32_t word_of(const std::uint8_t* bytes) {
    std::uint32_t word = 0;
    for (int i = 0; i < 4; ++i) word |= std::uint32_t{bytes[i]} << (8 * i);
    return word;
}

}  // namespace detail

constexpr Result<GenerationHeader> parse_generation_header(Span<const std::uint8_t> file) {
    if (file.size() < generation_header_bytes) return Status::truncated;
    for (int i = 0; i < 4; ++i)
        if (file[i] != detail::generation_magic[i]) return Status::malformed;
    if (detail::word_of(file.data() + 4) != detail::generation_version) return Status::unsupported;
    return GenerationHeader{detail::word_of(file.data() + 8), detail::word_of(file.data() + 12),
                            detail::word_of(file.data() + 16)};
}

/// As many bytes as there are, or the negative errno.
template <class System>
std::ptrdiff_t GenerationStorage<System>::read_up_to(int file, Span<std::uint8_t> into) {
    std::ptrdiff_t have = 0;
    while (have < into.size()) {
        const std::ptrdiff_t got = uninterrupted([&] { return system_.read(file, into.from(have)); });
        if (got < 0) return got;
        if (got == 0) break;
        have += got;
    }
    return have;
}

/// The bytes go to into, if it has room; else they are only looked at.
template <class System>
typename GenerationStorage<System>::State GenerationStorage<System>::check(int file, Span<std::uint8_t> into,
                                                                           Slot& slot) {
    const auto refused = [&](std::ptrdiff_t answer) {
        static_cast<void>(fail("read", static_cast<int>(-answer), Status::io_error, "a generation"));
        return State::unreadable;
    };
    const auto damaged = [&](const char* what) {
        static_cast<void>(fail("load", 0, Status::malformed, what));
        return State::damaged;
    };
    std::uint8_t head[generation_header_bytes];
    std::ptrdiff_t got = read_up_to(file, head);
    if (got < 0) return refused(got);
    const Result<GenerationHeader> header = parse_generation_header({head, got});
    if (!header) return damaged("the head of a generation is not one");
    Crc32 crc;
    crc.add(Span<const std::uint8_t>(head, generation_header_bytes - 4));
    std::int64_t left = header->bytes;
    const bool keep = left <= into.size();
    for (std::ptrdiff_t at = 0; left > 0; left -= got, at += got) {
        std::uint8_t some[512];
        const std::int64_t most = left < 512 ? left : 512;
        const Span<std::uint8_t> piece =
            keep ? into.from(at).first(left) : Span<std::uint8_t>(some).first(most);
        got = read_up_to(file, piece);
        if (got < 0) return refused(got);
        if (got < piece.size()) return damaged("a generation ends too early");
        crc.add(Span<const std::uint8_t>(piece));
    }
    std::uint8_t beyond[1];
    got = read_up_to(file, beyond);
    if (got < 0) return refused(got);
    if (got > 0) return damaged("a generation is followed by something");
    if (crc.value() != header->crc) return damaged("the checksum of a generation is wrong");
    slot.generation = header->generation;
    slot.bytes = header->bytes;
    return State::whole;
}

template <class System>
Status GenerationStorage<System>::inspect(const char* path, Span<std::uint8_t> into, Slot& slot) {
    slot = {};
    // A pipe under this name must not keep us.
    int file = uninterrupted([&] { return system_.open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); });
    if (file == -ENOENT) return Status::ok;
    if (file < 0 && file != -EIO) return fail("open", -file, Status::io_error, "a generation");
    slot.state = file < 0 ? State::unreadable : check(file, into, slot);
    if (file < 0) static_cast<void>(fail("open", -file, Status::io_error, "a generation"));
    static_cast<void>(close_file(system_, file));
    return Status::ok;
}

template <class System>
Status GenerationStorage<System>::inspect_both(const char* name, Slot (&slots)[2]) {
    fault_ = {};
    if (!Path(name).add(".new").fits() || name[0] == '\0')
        return fail("open", ENAMETOOLONG, Status::bad_argument, "a name is a path of 1 to 507 bytes");
    for (int i = 0; i < 2; ++i)
        if (const Status s = inspect(path_of(name, i).c_str(), {}, slots[i]); s != Status::ok) return s;
    return Status::ok;
}

/// -1 where none is whole.
template <class System>
int GenerationStorage<System>::newest(const Slot (&slots)[2]) {
    const bool a = slots[0].state == State::whole, b = slots[1].state == State::whole;
    if (a && b) return is_newer_generation(slots[1].generation, slots[0].generation) ? 1 : 0;
    return a ? 0 : b ? 1 : -1;
}

template <class System>
Result<Span<const std::uint8_t>> GenerationStorage<System>::load(const char* name) {
    fell_back_ = false;
    Slot slots[2];
    if (const Status s = inspect_both(name, slots); s != Status::ok) return s;
    if (slots[0].state == State::missing && slots[1].state == State::missing)
        return fail("open", ENOENT, Status::not_found, "");
    for (int which = newest(slots); which >= 0; which = newest(slots)) {
        const Slot looked_at = slots[which];
        if (looked_at.bytes > memory_.size())
            return fail("load", 0, Status::buffer_too_small, "more bytes than there is memory for");
        if (const Status s = inspect(path_of(name, which).c_str(), memory_, slots[which]); s != Status::ok)
            return s;
        if (slots[which].state == State::whole && slots[which].bytes == looked_at.bytes) {
            fell_back_ =
                slots[1 - which].state == State::damaged || slots[1 - which].state == State::unreadable;
            generation_ = slots[which].generation;
            return Span<const std::uint8_t>(memory_.first(looked_at.bytes));
        }
        // It was whole a moment ago.
        slots[which].state = State::damaged;
    }
    const bool unreadable = slots[0].state == State::unreadable || slots[1].state == State::unreadable;
    return fail("load", fault_.error, unreadable ? Status::io_error : Status::malformed,
                "no generation is whole");
}

template <class System>
Status GenerationStorage<System>::save(const char* name, Span<const std::uint8_t> bytes) {
    Slot slots[2];
    if (const Status s = inspect_both(name, slots); s != Status::ok) return s;
    if (bytes.size() > memory_.size() || static_cast<std::uint64_t>(bytes.size()) > 0xffffffffu)
        return fail("save", 0, Status::buffer_too_small, "more bytes than load() could give back");
    const bool unreadable[2] = {slots[0].state == State::unreadable, slots[1].state == State::unreadable};
    if (unreadable[0] && unreadable[1]) return fail("read", fault_.error, Status::io_error, "a generation");
    // What cannot be read may be the newest, so it is replaced: a number that follows that of the other is
    // enough. What is damaged is replaced before what is whole.
    const int last = newest(slots);
    int target = last == 0 ? 1 : 0;
    for (int i = 0; i < 2; ++i)
        if (unreadable[i]) target = i;
    const std::uint32_t generation = last < 0 ? 1 : slots[last].generation + 1;

    std::uint8_t head[generation_header_bytes];
    std::memcpy(head, detail::generation_magic, 4);
    detail::put_word(detail::generation_version, head + 4);
    detail::put_word(generation, head + 8);
    detail::put_word(static_cast<std::uint32_t>(bytes.size()), head + 12);
    Crc32 crc;
    crc.add(Span<const std::uint8_t>(head, generation_header_bytes - 4));
    crc.add(bytes);
    detail::put_word(crc.value(), head + 16);

    const char* const slash = std::strrchr(name, '/');
    const Path folder = slash == nullptr ? Path(".") : Path().add({name, slash - name + 1});
    fault_ = {};
    const Status status = replace_file(system_, folder.c_str(), Path(name).add(".new").c_str(),
                                       path_of(name, target).c_str(), head, bytes, fault_);
    if (status == Status::ok) generation_ = generation;
    return status;
}

}  // namespace fovea::linux_port
