// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/thrust_scale.h"

#include <limits>

#include "tests/support/catch.h"

namespace lodesman {
namespace {

TEST_CASE("thrust scale: command bytes mean shares of full thrust", "[drivers]") {
  const struct {
    std::uint8_t command;
    double share;
  } rows[] = {{0, -1.0},  {37, -90.0 / 127.0}, {126, -1.0 / 127.0}, {127, 0.0},
              {128, 0.0}, {129, 1.0 / 127.0},  {156, 28.0 / 127.0}, {255, 1.0}};
  for (const auto& row : rows) {
    INFO(int{row.command});
    CHECK(thrust_share(row.command) == Approx(row.share).margin(1e-15));
  }
  CHECK(thrust_share(37) == Approx(-0.709).margin(0.0005));
  CHECK(thrust_share(156) == Approx(0.220).margin(0.0005));
}

TEST_CASE("thrust scale: it rises, is odd about stop, and every command comes back", "[drivers]") {
  for (int value = 0; value <= 255; ++value) {
    const auto command = static_cast<std::uint8_t>(value);
    INFO(value);
    CHECK(thrust_share(command) == Approx(-thrust_share(static_cast<std::uint8_t>(255 - value))));
    CHECK(thrust_command(thrust_share(command)) == (value == 127 ? 128 : value));
    CHECK(is_neutral(command) == (value == 127 || value == 128));
    if (value > 0 && value != 128) {
      CHECK(thrust_share(command) > thrust_share(static_cast<std::uint8_t>(value - 1)));
    }
  }
}

TEST_CASE("thrust scale: what lies outside is clamped, and what is no number is stop",
          "[drivers]") {
  CHECK(thrust_command(1.5) == 255);
  CHECK(thrust_command(-std::numeric_limits<double>::infinity()) == 0);
  CHECK(thrust_command(std::numeric_limits<double>::quiet_NaN()) == 128);
  CHECK(thrust_command(0.003) == 128);
  CHECK(thrust_command(0.005) == 129);
  CHECK(thrust_command(-0.005) == 126);
}

TEST_CASE("thrust scale: the paper's duty is a view of the same bytes", "[drivers]") {
  const auto rounded = [](int command) {
    return std::lround(duty_percent(static_cast<std::uint8_t>(command)));
  };
  CHECK(rounded(0) == 0);
  CHECK(rounded(126) == 49);
  CHECK(rounded(127) == 50);
  CHECK(rounded(128) == 50);
  CHECK(rounded(129) == 51);
  CHECK(rounded(255) == 100);
  CHECK(duty_percent(156) == Approx(61.2).margin(0.05));
  CHECK(duty_percent(37) == Approx(14.5).margin(0.05));
  CHECK(is_neutral(ThrustCommand{127, 128}));
  CHECK_FALSE(is_neutral(ThrustCommand{128, 129}));
}

}  // namespace
}  // namespace lodesman
