// SPDX-License-Identifier: Apache-2.0
// A UDP socket over IPv4 that listens on a port of this computer and knows one peer: datagrams of
// any other address are dropped and counted (udp(7), ip(7)). Made at start-up; receive, reply and
// fault are one thread's.
//
// That nobody listens at the peer's port is known only after something was sent there, from the
// ICMP message that comes back (IP_RECVERR); where none comes back there is silence.
#pragma once

#include <netinet/in.h>

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "drivers/stream/datagram_socket.h"
#include "drivers/stream/file_descriptor.h"

namespace lodesman {

struct UdpOptions {
  std::string peer;             // its address, or a name that is looked up once; must not be empty
  std::uint16_t peer_port = 0;  // [-] 0: any of its ports, and nothing is sent before it has spoken
  std::uint16_t local_port = 0;  // [-] 0: a free one
};

class UdpSocket final : public DatagramSocket {
 public:
  // What is asked of the system for datagrams that wait: several pings of 60 256 bytes, with what
  // the kernel takes for each beside. It may give less: net.core.rmem_max.
  static constexpr int kWantedBuffer_bytes = 1 << 20;

  // on_datagram: called by a thread of the socket's when datagrams have come, at most every
  // millisecond; it must not block or throw. Empty: nobody is called and there is no thread. Throws
  // StartupError where the peer is not known, the port is taken, or the system has no socket left.
  explicit UdpSocket(const UdpOptions& options, std::function<void()> on_datagram = {});
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  ~UdpSocket() override;

  [[nodiscard]] Received receive(std::span<std::uint8_t> buffer) noexcept override;
  [[nodiscard]] bool reply(std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override { return fault_; }

  [[nodiscard]] std::uint16_t local_port() const noexcept { return local_port_; }
  // [-] what the system granted, by its own count, which holds its own expenses too.
  [[nodiscard]] int receive_buffer_bytes() const noexcept { return receive_buffer_bytes_; }
  // [-] datagrams of others that were dropped.
  [[nodiscard]] std::uint64_t foreign() const noexcept { return foreign_; }

 private:
  enum class Arrival : std::uint8_t { kNone, kForeign, kOurs };
  [[nodiscard]] Arrival receive_one(std::span<std::uint8_t> buffer, Received& received) noexcept;
  [[nodiscard]] bool is_of_peer(const sockaddr_in& from) const noexcept;
  void note_error(int error) noexcept;
  void attend() noexcept;

  const std::function<void()> on_datagram_;
  FileDescriptor socket_;
  FileDescriptor bell_;  // an eventfd: ends the thread
  sockaddr_in peer_{};   // port 0: not known yet
  bool any_port_ = false;
  std::uint16_t local_port_ = 0;
  int receive_buffer_bytes_ = 0;
  std::uint64_t foreign_ = 0;
  DeviceFault fault_ = DeviceFault::kNone;
  std::thread attendant_;
};

}  // namespace lodesman
