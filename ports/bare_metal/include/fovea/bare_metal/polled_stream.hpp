// SPDX-License-Identifier: MIT
//
// PolledStream: the byte stream of a UART that is asked, without interrupts.
#pragma once

#include <cstdint>

#include <fovea/base/span.hpp>
#include <fovea/base/status.hpp>
#include <fovea/hal/byte_stream.hpp>

namespace fovea::bare_metal {

/// A UART has bool receive(std::uint8_t& byte) and bool send(std::uint8_t byte): false where there is nothing
/// or no room. Bytes that arrive while nobody asks wait in the device's own queue and are lost beyond it.
template <class Uart>
class PolledStream {
public:
    explicit PolledStream(Uart uart) : uart_(uart) {}

    Result<int> read(Span<std::uint8_t> into) {
        int count = 0;
        while (count < into.size() && uart_.receive(into[count])) ++count;
        return count;
    }
    Result<int> write(Span<const std::uint8_t> bytes) {
        int count = 0;
        while (count < bytes.size() && uart_.send(bytes[count])) ++count;
        return count;
    }
    Uart& uart() { return uart_; }

private:
    Uart uart_;
};

}  // namespace fovea::bare_metal
