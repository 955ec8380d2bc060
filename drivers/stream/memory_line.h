// SPDX-License-Identifier: Apache-2.0
// A line of bytes in memory, between a driver and what stands in for its device: the driver has the
// near end, a ByteStream like any other; whoever makes the device's bytes has the far one. Each end
// is held by one thread, and they may be two; nothing blocks or allocates once it is made. Bytes
// carry the time at which they arrive, so that a slow line needs no clock.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "drivers/stream/byte_stream.h"

namespace lodesman {

// Bytes on their way in one direction: one writer, one reader, each its own thread.
class TimedBytes {
 public:
  static constexpr std::size_t kCapacity = 16384;

  // Writer. False where there is no room. Arrival times do not fall.
  bool push(std::uint8_t byte, Time arrives) noexcept;
  [[nodiscard]] std::size_t room() const noexcept;
  // Reader: what has arrived by `now`, the oldest first.
  [[nodiscard]] Received pop(std::span<std::uint8_t> into, Time now) noexcept;
  // Reader: drops what has arrived by `now`.
  void drop(Time now) noexcept;

 private:
  struct Byte {
    Time arrives{};
    std::uint8_t value = 0;
  };
  std::array<Byte, kCapacity> ring_{};
  alignas(64) std::atomic<std::size_t> written_{0};
  alignas(64) std::atomic<std::size_t> read_{0};
};

class MemoryLine {
 public:
  // Plugged from the beginning.
  MemoryLine() noexcept : near_{*this} {}
  MemoryLine(const MemoryLine&) = delete;
  MemoryLine& operator=(const MemoryLine&) = delete;
  ~MemoryLine() = default;

  [[nodiscard]] ByteStream& near_end() noexcept { return near_; }

  // The far end.
  // Bytes from the device; false where the line is full or not plugged in.
  bool send(std::uint8_t byte, Time arrives) noexcept;
  // Bytes to the device that have arrived by `now`.
  [[nodiscard]] Received receive(std::span<std::uint8_t> into, Time now) noexcept {
    return outward_.pop(into, now);
  }
  // Plugged again it is another connection, and nothing of the one before is given.
  void unplug() noexcept;
  void plug() noexcept;
  // What the near end was last told to speak at; 0: never told.
  [[nodiscard]] int baud() const noexcept { return baud_.load(std::memory_order_acquire); }
  // What a byte takes from the near end to the far one.
  void set_outward_delay(Duration delay) noexcept { outward_delay_ = delay; }
  // How many bytes to the device are held while it does not receive.
  void set_outward_room(std::size_t bytes) noexcept { outward_room_ = bytes; }

 private:
  class NearEnd final : public ByteStream {
   public:
    explicit NearEnd(MemoryLine& line) noexcept : line_{line} {}
    [[nodiscard]] std::uint64_t connection(Time now) noexcept override;
    [[nodiscard]] Received read(std::span<std::uint8_t> into, Time now) noexcept override;
    [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes,
                                    Time now) noexcept override;
    void reconnect(int baud) noexcept override;
    [[nodiscard]] DeviceFault fault() const noexcept override;

   private:
    [[nodiscard]] bool connected() const noexcept;

    MemoryLine& line_;
    std::uint64_t plug_ = 0;         // that this connection is of; 0: none
    std::uint64_t connections_ = 0;  // made so far
  };
  friend class NearEnd;

  TimedBytes inward_;                   // from the device
  TimedBytes outward_;                  // to the device
  std::atomic<std::uint64_t> plug_{1};  // odd: plugged; counts up at each change
  std::atomic<int> baud_{0};
  std::atomic<Duration> outward_delay_{Duration::zero()};
  std::atomic<std::size_t> outward_room_{TimedBytes::kCapacity};
  NearEnd near_;
};

}  // namespace lodesman
