// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/options.h"

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

namespace lodesman {
namespace {

[[nodiscard]] GpsdOptions options_of(const std::string& rest) {
  return gpsd_options({rest, gpsd_settings()});
}

TEST_CASE("gpsd options: a host, with gpsd's port unless it names another", "[gpsd]") {
  CHECK(options_of("localhost").place == "localhost:2947");
  CHECK(options_of("localhost:2948").place == "localhost:2948");
  CHECK(options_of("192.0.2.7").place == "192.0.2.7:2947");
  CHECK(options_of("[::1]").place == "[::1]:2947");
  CHECK(options_of("[::1]:2948").place == "[::1]:2948");
  const GpsdOptions set = options_of("localhost?device=/dev/ttyACM0&latency_s=0.1");
  CHECK(set.device == "/dev/ttyACM0");
  CHECK(set.latency == std::chrono::milliseconds{100});
}

TEST_CASE("gpsd options: what is no place of a gpsd is refused", "[gpsd]") {
  for (const char* rest : {"", ":2947", "localhost:", "localhost:0", "localhost:65536",
                           "localhost:x", "localhost?rate=5", "localhost?latency_s=2"}) {
    INFO(rest);
    CHECK_THROWS_AS(options_of(rest), StartupError);
  }
}

}  // namespace
}  // namespace lodesman
