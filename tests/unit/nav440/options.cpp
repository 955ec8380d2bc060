// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/options.h"

#include <cmath>

#include "mid_level/base/heading.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] Nav440Options read(const std::string& rest) {
  return nav440_options(DeviceAddress{rest, nav440_settings()});
}

[[nodiscard]] std::string refusal(const std::string& rest) {
  try {
    static_cast<void>(read(rest));
  } catch (const StartupError& error) {
    return error.what();
  }
  return {};
}

[[nodiscard]] bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

TEST_CASE("nav440 options: those of an address without settings", "[nav440]") {
  const Nav440Options options = read("/dev/ttyUSB0");
  CHECK(options.baud == 57600);
  CHECK(options.packet == Nav440Packet::kAuto);
  CHECK(options.rate_hz == 50);
  CHECK(std::abs(options.declination_rad) <= 0.0);
  CHECK(options.latency == Duration::zero());
  CHECK(options.line_has_speed);
}

TEST_CASE("nav440 options: each setting is read", "[nav440]") {
  const Nav440Options options =
      read("x?baud=38400&packet=N1&rate_hz=20&declination_deg=-7.6&latency_s=0.016");
  CHECK(options.baud == 38400);
  CHECK(options.packet == Nav440Packet::kN1);
  CHECK(options.rate_hz == 20);
  CHECK(options.declination_rad == Approx(to_rad(-7.6)));
  CHECK(options.latency == std::chrono::milliseconds{16});
  CHECK(nav440_settings().size() == 5);
}

TEST_CASE("nav440 options: what the unit has not is refused", "[nav440]") {
  CHECK(says(refusal("x?baud=115200"), "must be one of 9600, 19200, 38400, 57600"));
  CHECK(says(refusal("x?packet=A2"), "must be one of auto, A0, A1, N0, N1"));
  CHECK(says(refusal("x?rate_hz=30"), "must be one of 100, 50, 25, 20, 10, 5, 4, 2"));
  CHECK(says(refusal("x?rate_hz=1"), "from 2 to 100"));
  CHECK(says(refusal("x?declination_deg=181"), "from -180 to 180"));
  CHECK(says(refusal("x?latency_s=0.2"), "from 0 to 0.1"));
}

// The manual's packets, ten bits a byte.
TEST_CASE("nav440 options: what does not fit the line is refused with what does", "[nav440]") {
  const struct {
    const char* packet;
    std::array<int, 4> most_hz;  // at 9600, 19200, 38400 and 57600
  } rows[] = {{"A0", {25, 51, 103, 155}},
              {"A1", {24, 49, 98, 147}},
              {"N0", {24, 49, 98, 147}},
              {"N1", {19, 39, 78, 117}}};
  constexpr std::array<int, 4> kSpeeds{9600, 19200, 38400, 57600};
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < kSpeeds.size(); ++i) {
      CHECK(nav440::most_packets_hz(nav440::type_of(row.packet), kSpeeds[i]) == row.most_hz[i]);
      for (const int rate_hz : {2, 4, 5, 10, 20, 25, 50, 100}) {
        const std::string rest = "x?packet=" + std::string{row.packet} +
                                 "&baud=" + std::to_string(kSpeeds[i]) +
                                 "&rate_hz=" + std::to_string(rate_hz);
        INFO(rest);
        CHECK(refusal(rest).empty() == (rate_hz <= row.most_hz[i]));
      }
    }
  }
  CHECK(refusal("x?baud=38400&rate_hz=100") ==
        "packet A1 at 100 Hz does not fit a line of 38400 Bd, which carries 98 of them a second: "
        "rate_hz=50 fits, and so does baud=57600");
}

TEST_CASE("nav440 options: a line without a speed carries whatever it is given", "[nav440]") {
  Nav440Options options;
  options.rate_hz = 100;
  options.baud = 9600;
  CHECK_THROWS_AS(check_nav440_options(options), StartupError);
  options.line_has_speed = false;
  CHECK_NOTHROW(check_nav440_options(options));
}

}  // namespace
}  // namespace lodesman::testing
