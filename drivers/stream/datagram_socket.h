// SPDX-License-Identifier: Apache-2.0
// Datagrams both ways, never blocking: a UDP socket, or queues in memory. Held by one task, whose
// thread alone calls it; nothing here blocks, throws, allocates or asks for the time. A datagram
// arrives whole or not at all, but it may be lost, come twice or overtake another.
// tests/conformance/datagram_socket.cpp says the rest, for every implementation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mid_level/messages/health.h"

namespace lodesman {

// What one UDP datagram over IPv4 holds at most: 65535 less the headers (RFC 768, RFC 791).
inline constexpr std::size_t kLargestDatagram = 65507;

class DatagramSocket {
 public:
  struct Received {
    bool any = false;        // whether one had come; it may be empty
    bool truncated = false;  // the buffer was smaller, and the rest of it is lost
    std::size_t size = 0;    // [-] bytes in the buffer
  };

  DatagramSocket() = default;
  DatagramSocket(const DatagramSocket&) = delete;
  DatagramSocket& operator=(const DatagramSocket&) = delete;
  virtual ~DatagramSocket() = default;

  // The next datagram that has come, its first buffer.size() bytes.
  [[nodiscard]] virtual Received receive(std::span<std::uint8_t> buffer) noexcept = 0;

  // To whoever sent the last one that was received, or to the peer that the socket was made for;
  // false: there is none yet, or it did not go. That it went does not say that it arrives.
  [[nodiscard]] virtual bool reply(std::span<const std::uint8_t> bytes) noexcept = 0;

  // What ails the way to the peer, as far as the last calls have shown; kNone once one has come.
  [[nodiscard]] virtual DeviceFault fault() const noexcept { return DeviceFault::kNone; }
};

}  // namespace lodesman
