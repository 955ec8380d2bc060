// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/memory_datagrams.h"

#include <algorithm>

namespace lodesman {

bool DatagramQueue::push(std::span<const std::uint8_t> bytes) noexcept {
  const std::size_t at = written_.load(std::memory_order_relaxed);
  if (bytes.size() > kLargestDatagram || at - read_.load(std::memory_order_acquire) == kCapacity) {
    return false;
  }
  Slot& slot = ring_[at % kCapacity];
  slot.size = bytes.size();
  std::copy(bytes.begin(), bytes.end(), slot.bytes.begin());
  written_.store(at + 1, std::memory_order_release);
  return true;
}

DatagramSocket::Received DatagramQueue::pop(std::span<std::uint8_t> buffer) noexcept {
  const std::size_t at = read_.load(std::memory_order_relaxed);
  if (at == written_.load(std::memory_order_acquire)) {
    return {};
  }
  const Slot& slot = ring_[at % kCapacity];
  const std::size_t size = std::min(slot.size, buffer.size());
  std::copy_n(slot.bytes.begin(), size, buffer.begin());
  const DatagramSocket::Received received{true, size < slot.size, size};
  read_.store(at + 1, std::memory_order_release);
  return received;
}

DatagramSocket::Received MemoryDatagrams::End::receive(std::span<std::uint8_t> buffer) noexcept {
  const Received received = in_.pop(buffer);
  has_peer_ |= received.any;
  return received;
}

bool MemoryDatagrams::End::reply(std::span<const std::uint8_t> bytes) noexcept {
  return has_peer_ && is_plugged_.load(std::memory_order_acquire) && out_.push(bytes);
}

DeviceFault MemoryDatagrams::End::fault() const noexcept {
  return is_plugged_.load(std::memory_order_acquire) ? DeviceFault::kNone
                                                     : DeviceFault::kNobodyListens;
}

}  // namespace lodesman
