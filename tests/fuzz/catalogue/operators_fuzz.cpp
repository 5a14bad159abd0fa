// SPDX-License-Identifier: MIT
//
// Every operator of the catalogue with any parameters, right and wrong, on images of any small size: it stays
// in its memory, leaves the output alone when it refuses, and gives the same whatever stood in the scratch.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include <fovea/catalogue/operator.hpp>
#include <op/all_operators.hpp>
#include <support/operator_run.hpp>

using namespace fovea;

namespace {

/// Numbers from the input, zeros behind its end.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    std::uint8_t next() { return at_ < size_ ? data_[at_++] : std::uint8_t{0}; }
    int number() {
        const unsigned low = next();
        return static_cast<std::int16_t>(low | static_cast<unsigned>(next()) << 8);
    }

private:
    const std::uint8_t* data_;
    std::size_t size_;
    std::size_t at_ = 0;
};

const Operator& pick(Bytes& bytes) {
    static const std::vector<const Operator*> all = [] {
        std::vector<const Operator*> list;
        for (const OperatorFamily& family : apps::all_operators())
            for (const Operator& op : family.operators) list.push_back(&op);
        return list;
    }();
    return *all[(bytes.next() | static_cast<unsigned>(bytes.next()) << 8) % all.size()];
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const Operator& op = pick(bytes);
    const Size image{bytes.next() % 80, bytes.next() % 48};
    std::vector<int> values;
    for (int i = 0; i < op.parameter_count(); ++i) {
        const OperatorParameter& parameter = op.parameters[i];
        const int steps = (parameter.most - parameter.least) / parameter.step + 1;
        const int number = bytes.number();
        // Mostly allowed ones.
        values.push_back(number % 16 == 15 ? number
                                           : parameter.least + (number & 0x7fff) % steps * parameter.step);
    }
    test::OperatorRun first(op, image, values, bytes.next() % 5);
    if (first.call.output.size.area() > 1 << 20) return 0;
    test::OperatorRun second(op, image, values, 1);
    const std::uint32_t seed = bytes.next();
    const int block = 1 + bytes.next() % 9;
    first.fill(seed, block);
    second.fill(seed, block);
    second.dirty_scratch(0xee);
    const Status status = first.run();
    if (second.run() != status || !first.intact() || !second.intact()) std::abort();
    if (status == Status::ok ? !first.output().same_pixels(second.output()) : !first.output().untouched())
        std::abort();
    return 0;
}
