// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/fix_maker.h"

#include <cmath>

namespace lodesman::nav440 {
namespace {

// Stamps differ by the milliseconds of the unit's own time.
constexpr Duration kAlmost = std::chrono::milliseconds{10};

[[nodiscard]] std::optional<Place> place_in(PacketType type, Bytes payload) noexcept {
  const Packet packet = decoded(type, payload);
  if (const auto* n0 = std::get_if<N0>(&packet)) {
    return n0->place;
  }
  const auto* n1 = std::get_if<N1>(&packet);
  return n1 != nullptr ? std::optional{n1->place} : std::nullopt;
}

[[nodiscard]] PositionFix fix_of(const Place& place, Time measured) noexcept {
  PositionFix fix;
  fix.measured = measured;
  fix.latitude_deg = place.latitude_deg;
  fix.longitude_deg = place.longitude_deg;
  fix.sigma_m = fix_sigma_m(FixQuality::kUnknown, std::nullopt);
  fix.source = FixSource::kNav440;
  const double north_m_s = place.velocity_ned_m_s[0];
  const double east_m_s = place.velocity_ned_m_s[1];
  fix.has_speed = fix.has_course = true;
  fix.speed_m_s = std::hypot(north_m_s, east_m_s);
  fix.course_rad = std::atan2(east_m_s, north_m_s);
  return fix;
}

}  // namespace

void FixMaker::take(PacketType type, Bytes payload, std::uint16_t bit, Time measured) noexcept {
  if (relay_ == nullptr || (given_ != Time{} && measured - given_ + kAlmost < kFixPeriod)) {
    return;
  }
  const std::optional<Place> place = place_in(type, payload);
  if (!place || is_nowhere(place->latitude_deg, place->longitude_deg) ||
      (bit & kHardwareStatus) != 0) {
    ails_ = DeviceFault::kNoFix;
    return;
  }
  given_ = measured;
  const PositionFix fix = fix_of(*place, measured);
  const bool is_frozen = frozen_.frozen(fix);
  ails_ = is_frozen ? DeviceFault::kFrozen : DeviceFault::kNone;
  if (!is_frozen) {
    static_cast<void>(relay_->push(fix));
  }
}

void FixMaker::tell(bool is_connected, DeviceFault fault) noexcept {
  if (relay_ != nullptr) {
    relay_->tell({is_connected, fault == DeviceFault::kNone ? ails_ : fault});
  }
}

}  // namespace lodesman::nav440
