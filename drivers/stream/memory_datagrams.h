// SPDX-License-Identifier: Apache-2.0
// Datagrams in memory, between a driver and what stands in for its device. The near end listens and
// answers whoever spoke, as a driver does; the far one has the near one for its peer and may speak
// first, as a device does. What finds a queue full is lost, as at a socket. Each end has one
// thread, which may be the same: lock-step.
//
// A queue is a ring with one writer and one reader. The writer fills a slot and then counts up
// `written_` with a release; the reader sees the slot after an acquire of it, empties it and counts
// up `read_` with a release, after whose acquire alone the writer fills the slot again.
#pragma once

#include <array>
#include <atomic>

#include "drivers/stream/datagram_socket.h"

namespace lodesman {

class DatagramQueue {
 public:
  // More than a sonar sends between two polls of its task.
  static constexpr std::size_t kCapacity = 8;

  // Writer. False where it is too long or there is no room.
  bool push(std::span<const std::uint8_t> bytes) noexcept;
  // Reader.
  [[nodiscard]] DatagramSocket::Received pop(std::span<std::uint8_t> buffer) noexcept;

 private:
  struct Slot {
    std::size_t size = 0;
    std::array<std::uint8_t, kLargestDatagram> bytes{};
  };
  std::array<Slot, kCapacity> ring_{};
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

// About a mebibyte: too large for a stack.
class MemoryDatagrams {
 public:
  // Plugged from the beginning.
  MemoryDatagrams() noexcept
      : near_{to_near_, to_far_, is_plugged_, false}, far_{to_far_, to_near_, is_plugged_, true} {}
  MemoryDatagrams(const MemoryDatagrams&) = delete;
  MemoryDatagrams& operator=(const MemoryDatagrams&) = delete;
  ~MemoryDatagrams() = default;

  [[nodiscard]] DatagramSocket& near_end() noexcept { return near_; }
  [[nodiscard]] DatagramSocket& far_end() noexcept { return far_; }

  // The far end's: while it is unplugged nothing goes either way.
  void unplug() noexcept { is_plugged_.store(false, std::memory_order_release); }
  void plug() noexcept { is_plugged_.store(true, std::memory_order_release); }

 private:
  class End final : public DatagramSocket {
   public:
    End(DatagramQueue& in, DatagramQueue& out, const std::atomic<bool>& is_plugged,
        bool has_peer) noexcept
        : in_{in}, out_{out}, is_plugged_{is_plugged}, has_peer_{has_peer} {}
    [[nodiscard]] Received receive(std::span<std::uint8_t> buffer) noexcept override;
    [[nodiscard]] bool reply(std::span<const std::uint8_t> bytes) noexcept override;
    [[nodiscard]] DeviceFault fault() const noexcept override;

   private:
    DatagramQueue& in_;
    DatagramQueue& out_;
    const std::atomic<bool>& is_plugged_;
    bool has_peer_;
  };

  DatagramQueue to_near_;
  DatagramQueue to_far_;
  std::atomic<bool> is_plugged_{true};
  End near_;
  End far_;
};

}  // namespace lodesman
