// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/fix_check.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace lodesman {
namespace {

// What a receiver's range error comes to in the plane at an HDOP of 1, and what no HDOP betters.
struct Accuracy {
  double per_hdop_m;
  double least_m;
};

[[nodiscard]] Accuracy accuracy_of(FixQuality quality) noexcept {
  switch (quality) {
    case FixQuality::kDifferential: return {1.0, 0.5};
    case FixQuality::kRtkFloat: return {0.4, 0.2};
    case FixQuality::kRtkFixed: return {0.02, 0.02};
    case FixQuality::kUnknown:
    case FixQuality::kSingle: break;
  }
  return {3.0, 1.5};
}

constexpr double kUnknownHdop = 2.0;
constexpr double kLeastHdop = 0.5;
constexpr double kMostHdop = 50.0;

// A metre of either: no receiver comes so close by chance.
constexpr double kNowhere_deg = 1e-5;

constexpr std::uint32_t kTenFixes = 0x3FF;
constexpr int kLively = 8;  // of them

}  // namespace

double fix_sigma_m(FixQuality quality, std::optional<double> hdop) noexcept {
  const double given = hdop.value_or(kUnknownHdop);
  const double used = given > 0.0 ? std::clamp(given, kLeastHdop, kMostHdop) : kUnknownHdop;
  const Accuracy accuracy = accuracy_of(quality);
  return std::max(accuracy.least_m, accuracy.per_hdop_m * used);
}

bool is_nowhere(double latitude_deg, double longitude_deg) noexcept {
  return std::abs(latitude_deg) < kNowhere_deg && std::abs(longitude_deg) < kNowhere_deg;
}

bool FrozenPosition::frozen(const PositionFix& fix) noexcept {
  // To the bit: the same digits.
  const bool differs = !any_ ||
                       std::bit_cast<std::uint64_t>(fix.latitude_deg) !=
                           std::bit_cast<std::uint64_t>(latitude_deg_) ||
                       std::bit_cast<std::uint64_t>(fix.longitude_deg) !=
                           std::bit_cast<std::uint64_t>(longitude_deg_);
  past_ = (past_ << 1U) | (any_ && differs ? 1U : 0U);
  if (differs) {
    any_ = true;
    latitude_deg_ = fix.latitude_deg;
    longitude_deg_ = fix.longitude_deg;
    was_lively_ = std::popcount(past_ & kTenFixes) >= kLively;
    moving_since_ = {};
  }
  const bool moves = fix.has_speed ? fix.speed_m_s >= kUnderWay_m_s : was_lively_;
  if (!moves) {
    moving_since_ = {};
    return false;
  }
  if (moving_since_ == Time{}) {
    moving_since_ = fix.measured;
  }
  return fix.measured - moving_since_ >= kFrozenFor;
}

}  // namespace lodesman
