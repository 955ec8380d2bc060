// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/campaign/encounter.h"

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "mid_level/base/random_stream.h"

namespace lodesman {
namespace {

constexpr std::string_view kPrefix = "encounter:";
constexpr std::array kSpeeds_m_s{0.22, 0.42, 0.74, 1.12};
constexpr double kFromStart_m = 4.0;
constexpr double kFromGoal_m = 3.0;
constexpr int kTries_max = 200;

struct Point {
  double x_m = 0.0;
  double y_m = 0.0;
};

template <class... Numbers>
[[nodiscard]] std::string line(const char* format, Numbers... numbers) {
  std::array<char, 256> text{};
  const int length = std::snprintf(text.data(), text.size(), format, numbers...);
  return {text.data(), static_cast<std::size_t>(length)};
}

class Generator {
 public:
  explicit Generator(std::uint64_t number) : random_{"encounter", number} {
    speed_m_s_ = kSpeeds_m_s[index(kSpeeds_m_s.size())];
    goal_ = {between(-4.0, 4.0), between(18.0, 24.0)};
  }

  [[nodiscard]] std::string scenario(std::uint64_t number) {
    const double way_m = std::hypot(goal_.x_m, goal_.y_m);
    std::string text =
        "name = \"encounter\"\n" +
        line("seed = %llu\n", static_cast<unsigned long long>(number % 1000000007U)) +
        line("time_limit_s = %.1f\n", 3.0 * way_m / speed_m_s_ + 60.0) +
        "[mission]\nstart_m = [0.0, 0.0]\nstart_heading_deg = 0.0\n" +
        line("goal_m = [%.3f, %.3f]\n", goal_.x_m, goal_.y_m) + "goal_radius_m = 0.5\n[vehicle]\n" +
        line("speed_m_s = %.2f\n", speed_m_s_) + "radius_m = 0.5\n";
    const std::size_t count = 1 + index(8);
    for (std::size_t i = 0; i < count; ++i) {
      text += obstacle();
    }
    return text;
  }

 private:
  [[nodiscard]] double between(double low, double high) {
    return low + (high - low) * random_.uniform();
  }
  [[nodiscard]] std::size_t index(std::size_t count) {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(count));
  }

  [[nodiscard]] std::string obstacle() {
    const bool moves = random_.uniform() < 0.5;
    const bool ellipse = random_.uniform() < 0.3;
    const double first_m = between(0.2, 1.2);
    const double second_m = ellipse ? between(0.2, 1.2) : first_m;
    const double size_m = std::max(first_m, second_m);
    Point at;
    Point velocity;
    bool placed = false;
    for (int attempt = 0; attempt < kTries_max && !placed; ++attempt) {
      // Where the vehicle would be some time, a little beside it.
      const double share = between(0.2, 0.95);
      at = {share * goal_.x_m + between(-3.0, 3.0), share * goal_.y_m + between(-1.0, 1.0)};
      velocity = {};
      if (moves) {
        const double after_s = share * std::hypot(goal_.x_m, goal_.y_m) / speed_m_s_;
        const double speed_m_s = between(0.05, 0.8);
        const double course_rad = between(0.0, 2.0 * std::numbers::pi);
        velocity = {speed_m_s * std::sin(course_rad), speed_m_s * std::cos(course_rad)};
        at = {at.x_m - after_s * velocity.x_m, at.y_m - after_s * velocity.y_m};
      }
      const double to_start_m = std::hypot(at.x_m, at.y_m) - size_m;
      const double to_goal_m = std::hypot(at.x_m - goal_.x_m, at.y_m - goal_.y_m) - size_m;
      placed = to_start_m >= kFromStart_m && (moves || to_goal_m >= kFromGoal_m);
    }
    if (!placed) {
      return {};
    }
    std::string text = "[[obstacle]]\n";
    if (ellipse) {
      text += "shape = \"ellipse\"\n" + line("semi_axes_m = [%.3f, %.3f]\n", first_m, second_m) +
              line("angle_deg = %.1f\n", between(0.0, 180.0)) +
              line("protection_semi_axes_m = [%.3f, %.3f]\n", first_m + 1.5, second_m + 1.5);
    } else {
      text += "shape = \"circle\"\n" + line("radius_m = %.3f\n", first_m) +
              line("protection_m = %.3f\n", first_m + 1.5);
    }
    text += line("centre_m = [%.3f, %.3f]\n", at.x_m, at.y_m);
    if (moves) {
      text += line("velocity_m_s = [%.3f, %.3f]\n", velocity.x_m, velocity.y_m);
    }
    return text;
  }

  RandomStream random_;
  double speed_m_s_ = 0.0;
  Point goal_;
};

}  // namespace

std::string encounter_scenario(std::uint64_t number) { return Generator{number}.scenario(number); }

std::optional<std::uint64_t> encounter_number(std::string_view name) noexcept {
  if (!name.starts_with(kPrefix)) {
    return std::nullopt;
  }
  const std::string_view digits = name.substr(kPrefix.size());
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return error == std::errc{} && end == digits.data() + digits.size() ? std::optional{number}
                                                                      : std::nullopt;
}

}  // namespace lodesman
