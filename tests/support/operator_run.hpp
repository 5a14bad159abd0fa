// SPDX-License-Identifier: MIT
//
// OperatorRun: memory around an operator of the catalogue, with guards that must survive. Host tests only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include <fovea/base/random.hpp>
#include <fovea/catalogue/operator.hpp>

namespace fovea::test {

/// An image of any pixel with guard bytes before, after and between the rows.
class GuardedBytes {
public:
    GuardedBytes(Size size, PixelKind kind, int padding_pixels)
        : size_(size),
          row_bytes_(static_cast<std::size_t>(bytes_of(kind)) *
                     static_cast<std::size_t>(size.empty() ? 0 : size.width)),
          stride_(row_bytes_ + static_cast<std::size_t>(bytes_of(kind) * padding_pixels)),
          bytes_(2 * margin + stride_ * static_cast<std::size_t>(size.empty() ? 0 : size.height), guard) {}

    AnyImage image() { return {bytes_.data() + margin, size_, static_cast<std::ptrdiff_t>(stride_)}; }
    std::uint8_t* row(int y) { return bytes_.data() + margin + static_cast<std::size_t>(y) * stride_; }
    std::size_t row_bytes() const { return row_bytes_; }
    int rows() const { return size_.empty() ? 0 : size_.height; }

    /// Random bytes, or blocks of random bytes, so that there are flat places too.
    void fill(std::uint32_t seed, int block) {
        for (int y = 0; y < rows(); ++y)
            for (std::size_t i = 0; i < row_bytes_; ++i) {
                const auto bx = static_cast<std::uint32_t>(i / static_cast<std::size_t>(block));
                const auto by = static_cast<std::uint32_t>(y / block);
                std::uint32_t mixed = (bx * 0x9e3779b1u) ^ (by * 0x85ebca77u) ^ (seed * 0xc2b2ae3du);
                mixed ^= mixed >> 15;
                mixed *= 0x2c1b3c6du;
                row(y)[i] = static_cast<std::uint8_t>(mixed >> 24);
            }
    }
    bool intact() const {
        std::vector<std::uint8_t> copy = bytes_;
        for (int y = 0; y < rows(); ++y)
            std::memset(copy.data() + margin + static_cast<std::size_t>(y) * stride_, guard, row_bytes_);
        for (const std::uint8_t byte : copy)
            if (byte != guard) return false;
        return true;
    }
    bool untouched() const {
        for (const std::uint8_t byte : bytes_)
            if (byte != guard) return false;
        return true;
    }
    bool same_pixels(GuardedBytes& other) {
        if (other.size_ != size_) return false;
        for (int y = 0; y < rows(); ++y)
            if (std::memcmp(row(y), other.row(y), row_bytes_) != 0) return false;
        return true;
    }

private:
    static constexpr std::size_t margin = 64;
    static constexpr std::uint8_t guard = 0xa5;
    Size size_;
    std::size_t row_bytes_;
    std::size_t stride_;
    std::vector<std::uint8_t> bytes_;
};

/// An operator with inputs, output and scratch of its own.
class OperatorRun {
public:
    /// The largest output that is given memory; a test that asks for more is wrong.
    static constexpr std::int64_t most_bytes = 64 << 20;

    OperatorRun(const Operator& op, Size size, const std::vector<int>& values, int padding = 3)
        : op_(op), output_(output_size(op, size, values), op.output, padding) {
        for (int i = 0; i < op.input_count(); ++i) inputs_.emplace_back(size, op.inputs[i], padding);
        for (int i = 0; i < op.parameter_count(); ++i) call.values[i] = values[static_cast<std::size_t>(i)];
        const std::int64_t scratch = size.empty() ? 0 : op.scratch_for(size, call.values);
        scratch_.resize(scratch > 0 && scratch < most_bytes ? static_cast<std::size_t>(scratch) : 0);
        for (int i = 0; i < op.input_count(); ++i)
            call.inputs[i] = inputs_[static_cast<std::size_t>(i)].image();
        call.scratch = {scratch_.data(), static_cast<std::ptrdiff_t>(scratch_.size())};
        call.output = output_.image();
    }
    OperatorRun(const OperatorRun&) = delete;

    static std::vector<int> presets(const Operator& op) {
        std::vector<int> values;
        for (int i = 0; i < op.parameter_count(); ++i) values.push_back(op.parameters[i].preset);
        return values;
    }

    void fill(std::uint32_t seed, int block = 1) {
        for (GuardedBytes& input : inputs_) input.fill(seed++, block);
    }
    void dirty_scratch(std::uint8_t with) {
        scratch_.assign(scratch_.size(), with);
        call.scratch = {scratch_.data(), call.scratch.size()};
    }
    Status run() { return run_operator(op_, call); }
    Status run_unchecked() { return op_.run(call); }
    GuardedBytes& input(int number) { return inputs_[static_cast<std::size_t>(number)]; }
    GuardedBytes& output() { return output_; }
    bool intact() const {
        for (const GuardedBytes& input : inputs_)
            if (!input.intact()) return false;
        return output_.intact();
    }

    OperatorCall call;

private:
    static Size output_size(const Operator& op, Size size, const std::vector<int>& values) {
        int all[max_operator_parameters] = {};
        for (std::size_t i = 0; i < values.size() && i < max_operator_parameters; ++i) all[i] = values[i];
        return size.empty() ? size : op.size_for(size, all);
    }

    const Operator& op_;
    std::vector<GuardedBytes> inputs_;
    GuardedBytes output_;
    std::vector<std::uint8_t> scratch_;
};

}  // namespace fovea::test
