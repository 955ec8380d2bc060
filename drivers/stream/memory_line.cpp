// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/memory_line.h"

#include <algorithm>

namespace lodesman {

bool TimedBytes::push(std::uint8_t byte, Time arrives) noexcept {
  if (room() == 0) {
    return false;
  }
  const std::size_t at = written_.load(std::memory_order_relaxed);
  ring_[at % kCapacity] = {arrives, byte};
  written_.store(at + 1, std::memory_order_release);
  return true;
}

std::size_t TimedBytes::room() const noexcept {
  return kCapacity -
         (written_.load(std::memory_order_relaxed) - read_.load(std::memory_order_acquire));
}

Received TimedBytes::pop(std::span<std::uint8_t> into, Time now) noexcept {
  Received received{0, now};
  const std::size_t end = written_.load(std::memory_order_acquire);
  std::size_t at = read_.load(std::memory_order_relaxed);
  for (; at != end && received.count < into.size(); ++at) {
    const Byte& byte = ring_[at % kCapacity];
    if (byte.arrives > now) {
      break;
    }
    into[received.count++] = byte.value;
    received.at = byte.arrives;
  }
  read_.store(at, std::memory_order_release);
  return received;
}

void TimedBytes::drop(Time now) noexcept {
  std::array<std::uint8_t, 64> dropped{};
  while (pop(dropped, now).count > 0) {
  }
}

bool MemoryLine::send(std::uint8_t byte, Time arrives) noexcept {
  return plug_.load(std::memory_order_relaxed) % 2 == 1 && inward_.push(byte, arrives);
}

void MemoryLine::unplug() noexcept {
  if (const auto plug = plug_.load(std::memory_order_relaxed); plug % 2 == 1) {
    plug_.store(plug + 1, std::memory_order_release);
  }
}

void MemoryLine::plug() noexcept {
  if (const auto plug = plug_.load(std::memory_order_relaxed); plug % 2 == 0) {
    plug_.store(plug + 1, std::memory_order_release);
  }
}

bool MemoryLine::NearEnd::connected() const noexcept {
  return plug_ != 0 && line_.plug_.load(std::memory_order_acquire) == plug_;
}

std::uint64_t MemoryLine::NearEnd::connection(Time now) noexcept {
  if (!connected()) {
    const std::uint64_t plug = line_.plug_.load(std::memory_order_acquire);
    if (plug % 2 == 0) {
      plug_ = 0;
      return 0;
    }
    line_.inward_.drop(now);
    plug_ = plug;
    ++connections_;
  }
  return connections_;
}

Received MemoryLine::NearEnd::read(std::span<std::uint8_t> into, Time now) noexcept {
  return connected() ? line_.inward_.pop(into, now) : Received{0, now};
}

std::size_t MemoryLine::NearEnd::write(std::span<const std::uint8_t> bytes, Time now) noexcept {
  if (!connected()) {
    return 0;
  }
  TimedBytes& outward = line_.outward_;
  const std::size_t held = TimedBytes::kCapacity - outward.room();
  const std::size_t room_max = line_.outward_room_.load(std::memory_order_relaxed);
  const std::size_t taken = std::min(bytes.size(), room_max > held ? room_max - held : 0);
  const Time arrives = now + line_.outward_delay_.load(std::memory_order_relaxed);
  for (const std::uint8_t byte : bytes.first(taken)) {
    outward.push(byte, arrives);
  }
  return taken;
}

void MemoryLine::NearEnd::reconnect(int baud) noexcept {
  line_.baud_.store(baud, std::memory_order_release);
  plug_ = 0;
}

DeviceFault MemoryLine::NearEnd::fault() const noexcept {
  if (line_.plug_.load(std::memory_order_acquire) % 2 == 1) {
    return DeviceFault::kNone;
  }
  return connections_ == 0 ? DeviceFault::kNoPort : DeviceFault::kUnplugged;
}

}  // namespace lodesman
