// SPDX-License-Identifier: MIT
//
// A chip that measures in frames it could not hold, on its serial line: tests/target/lines.txt.
#include <cstdint>

#include <board.hpp>
#include <fovea/bare_metal/memory_layout.hpp>
#include <fovea/hal/feed.hpp>
#include <fovea/hal/line_source.hpp>
#include <target/lines.hpp>
#include <target/print.hpp>

namespace {
using namespace fovea;

target::LineGauge gauge;
Gray8 line[target::LineGauge::size.width];

/// A sensor that shows a scene, once. It has one line of memory, and every second time it is asked its line
/// is not there yet.
template <class Scene>
class SceneLines {
public:
    explicit SceneLines(Scene& scene) : scene_(scene) {}

    static Size size() { return Scene::size; }
    Status start() {
        rows_left_ = Scene::size.height;
        return Status::ok;
    }
    Result<Span<const std::uint8_t>> next() {
        waiting_ = !waiting_;
        if (waiting_ || rows_left_ == 0) return Span<const std::uint8_t>();
        --rows_left_;
        scene_.take(line);
        return Span<const std::uint8_t>(line);
    }

private:
    Scene& scene_;
    int rows_left_ = 0;
    bool waiting_ = false;
};
static_assert(hal::is_line_source_v<SceneLines<target::PlateScene>>);

struct Printer {
    board::Serial& serial;

    void operator()(const char* text) const { target::print(serial, text); }
    void operator()(std::int64_t number) const {
        target::print(serial, " ");
        target::print_long(serial, number);
    }
};
}  // namespace

int main() {
    auto serial = board::start_serial();
    gauge.measure_all(
        [](auto& scene, auto& program, Span<std::uint8_t> scratch) {
            SceneLines lines(scene);
            if (Status s = hal::begin_frame(lines, program, Border::replicate, scratch); s != Status::ok)
                return s;
            Result<bool> complete = false;
            while (complete && !*complete) complete = hal::pump(lines, program);
            return complete.status();
        },
        Printer{serial});
    target::print(serial, "# bytes of stack ");
    target::print_long(serial, bare_metal::deepest_stack());
    target::print(serial, " of ");
    target::print_long(serial, 4 * (fovea_stack_top - fovea_stack_limit));
    target::print(serial, ", of memory ");
    target::print_long(serial, 4 * (fovea_bss_end - fovea_stack_limit));
    target::print(serial, "\n");
    return 0;
}
