// SPDX-License-Identifier: Apache-2.0
// What the suite of the datagram sockets asks of each implementation: a near end that listens and a
// far one that has it for a peer.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/stream/memory_datagrams.h"
#include "drivers/stream/udp_socket.h"
#include "tests/support/pty_device.h"

namespace lodesman::conformance {

using Bytes = std::vector<std::uint8_t>;

class MemoryDatagramsBench {
 public:
  [[nodiscard]] DatagramSocket& near_end() { return pair_->near_end(); }
  [[nodiscard]] DatagramSocket& far_end() { return pair_->far_end(); }

 private:
  std::unique_ptr<MemoryDatagrams> pair_ = std::make_unique<MemoryDatagrams>();
};

class UdpBench {
 public:
  [[nodiscard]] DatagramSocket& near_end() { return near_; }
  [[nodiscard]] DatagramSocket& far_end() { return far_; }

 private:
  UdpSocket near_{{"127.0.0.1"}};
  UdpSocket far_{{"127.0.0.1", near_.local_port()}};
};

struct Arrived {
  bool any = false;
  bool truncated = false;
  Bytes bytes;
};

// What comes next at that end, waited for where it is on its way.
[[nodiscard]] inline Arrived next_at(DatagramSocket& end, std::size_t room = 65536) {
  Arrived arrived;
  arrived.bytes.resize(room);
  DatagramSocket::Received received;
  arrived.any = testing::eventually([&] { return (received = end.receive(arrived.bytes)).any; });
  arrived.truncated = received.truncated;
  arrived.bytes.resize(received.size);
  return arrived;
}

// Told apart from any other by its seed.
[[nodiscard]] inline Bytes datagram(std::size_t size, std::size_t seed = 0) {
  Bytes bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::uint8_t>((seed + i) * 7 + i / 256);
  }
  return bytes;
}

}  // namespace lodesman::conformance
