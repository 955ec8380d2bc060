// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/nav440_settings.h"

#include <algorithm>

#include "hal_sim/emulators/emulated_device.h"

namespace lodesman::emulated {
namespace {

constexpr std::uint16_t kFieldNone = 0x000F;  // a gap in the manual's list
constexpr std::uint16_t kFieldOrientation = 0x0007;
constexpr std::uint16_t kFieldBehaviour = 0x0008;
constexpr std::uint16_t kFieldPortBBaud = 0x0014;
constexpr std::uint16_t kFieldMaskFirst = 0x0010;
constexpr std::uint16_t kFieldMaskLast = 0x0013;

constexpr std::array<std::uint16_t, 9> kDividers{0, 1, 2, 4, 5, 10, 20, 25, 50};
constexpr std::array<int, 4> kBauds{9600, 19200, 38400, 57600};
constexpr int kInternalRate_hz = 100;
constexpr std::size_t kFrameOverhead = 7;
constexpr std::uint16_t kBehaviourBits = 0x003F;
// The four rotations of each axis that points down.
constexpr std::array<std::uint16_t, 24> kOrientations{
    0x0000, 0x0009, 0x0023, 0x002A, 0x0041, 0x0048, 0x0062, 0x006B, 0x0085, 0x008C, 0x0092, 0x009B,
    0x00C4, 0x00CD, 0x00D3, 0x00DA, 0x0111, 0x0118, 0x0124, 0x012D, 0x0150, 0x0159, 0x0165, 0x016C};

template <class List>
[[nodiscard]] bool holds(const List& list, std::uint16_t value) noexcept {
  return std::find(list.begin(), list.end(), value) != list.end();
}

}  // namespace

Nav440Settings::Nav440Settings(std::uint16_t divider, std::uint16_t baud_code,
                               std::uint16_t packet_type) {
  set(kFieldDivider, divider);
  set(kFieldBaud, baud_code);
  set(kFieldPacketType, packet_type);
  for (std::uint16_t id = kFieldMaskFirst; id <= kFieldMaskLast; ++id) {
    set(id, 0xFFFF);
  }
}

bool Nav440Settings::has(std::uint16_t id) noexcept {
  return id >= kFieldDivider && id < kIds && id != kFieldNone;
}

bool Nav440Settings::allows(std::uint16_t id, std::uint16_t value) noexcept {
  switch (id) {
    case kFieldDivider: return holds(kDividers, value);
    case kFieldBaud: return value < kBauds.size();
    case kFieldOrientation: return holds(kOrientations, value);
    case kFieldBehaviour: return (value & ~kBehaviourBits) == 0;
    case kFieldPortBBaud: return value < kBauds.size() || value == 0xFFFF;
    default: return has(id);
  }
}

int Nav440Settings::baud() const noexcept { return kBauds[at(kFieldBaud)]; }

bool Nav440Settings::fits(std::size_t payload) const noexcept {
  const auto divider = static_cast<std::size_t>(at(kFieldDivider));
  const std::size_t bits = (payload + kFrameOverhead) * static_cast<std::size_t>(kBitsAByte);
  return divider == 0 || bits * kInternalRate_hz <= static_cast<std::size_t>(baud()) * divider;
}

}  // namespace lodesman::emulated
