// SPDX-License-Identifier: Apache-2.0
// Heading: an angle clockwise from the world's +y axis (north), as a compass shows it. The
// paper's psi, counter-clockwise, lives only inside the functions of eqs 2 and 9. Any thread.
#pragma once

#include <cmath>
#include <numbers>

namespace lodesman {

[[nodiscard]] constexpr double to_rad(double deg) noexcept {
  return deg * (std::numbers::pi / 180.0);
}
[[nodiscard]] constexpr double to_deg(double rad) noexcept {
  return rad * (180.0 / std::numbers::pi);
}

// Into [-pi, pi].
[[nodiscard]] inline double wrap_to_pi(double rad) noexcept {
  return std::remainder(rad, 2.0 * std::numbers::pi);
}

// Into [0, 360), for files and displays.
[[nodiscard]] inline double compass_deg(double rad) noexcept {
  const double deg = std::fmod(to_deg(rad), 360.0);
  const double positive = deg < 0.0 ? deg + 360.0 : deg;
  return positive >= 360.0 ? 0.0 : positive;
}

class Heading {
 public:
  constexpr Heading() noexcept = default;  // north
  [[nodiscard]] static Heading clockwise_from_y_rad(double rad) noexcept {
    return Heading{wrap_to_pi(rad)};
  }
  // The direction of a displacement (x east, y north); north for a zero displacement.
  [[nodiscard]] static Heading of_displacement(double x_m, double y_m) noexcept {
    return Heading{std::atan2(x_m, y_m)};
  }
  [[nodiscard]] double rad() const noexcept { return rad_; }  // [-pi, pi]
  // How far to turn right to get from this heading to `other`, in [-pi, pi].
  [[nodiscard]] double turn_to_rad(Heading other) const noexcept {
    return wrap_to_pi(other.rad_ - rad_);
  }

 private:
  explicit constexpr Heading(double rad) noexcept : rad_{rad} {}
  double rad_ = 0.0;
};

}  // namespace lodesman
