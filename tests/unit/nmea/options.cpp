// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/options.h"

#include <string>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

[[nodiscard]] NmeaOptions options_of(const std::string& rest) {
  return nmea_options({rest, nmea_settings()});
}

TEST_CASE("nmea options: a speed and a latency, each with a value of its own without it",
          "[nmea]") {
  CHECK(options_of("/dev/ttyUSB2").baud == 9600);
  CHECK(options_of("/dev/ttyUSB2").latency == Duration::zero());
  const NmeaOptions set = options_of("/dev/ttyUSB2?baud=115200&latency_s=0.08");
  CHECK(set.baud == 115200);
  CHECK(set.latency == std::chrono::milliseconds{80});
}

TEST_CASE("nmea options: what is no setting of it is refused", "[nmea]") {
  for (const char* rest : {"/dev/ttyUSB2?baud=9601", "/dev/ttyUSB2?latency_s=1.5",
                           "/dev/ttyUSB2?latency_s=-0.1", "/dev/ttyUSB2?rate_hz=5"}) {
    INFO(rest);
    CHECK_THROWS_AS(options_of(rest), StartupError);
  }
}

}  // namespace
}  // namespace lodesman::testing
