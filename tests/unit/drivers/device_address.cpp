// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/device_address.h"

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {
DeviceAddress read(std::string_view rest) { return {rest, {"baud", "packet", "offset_deg"}}; }

// With what words it is refused; empty where it is not.
template <class Use>
std::string refusal(Use use) {
  try {
    static_cast<void>(use());
  } catch (const StartupError& error) {
    return error.what();
  }
  return {};
}
bool says(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST_CASE("device address: a place alone", "[drivers]") {
  const DeviceAddress address = read("/dev/ttyUSB0");
  CHECK(address.place() == "/dev/ttyUSB0");
  CHECK_FALSE(address.has("baud"));
  CHECK(address.integer("baud", 38400, 0, 1000000) == 38400);
  CHECK(address.word("packet", "A1", {"A1", "N1"}) == "A1");
}

TEST_CASE("device address: a place and settings", "[drivers]") {
  const DeviceAddress address = read("/dev/ttyUSB0?baud=57600&packet=N1&offset_deg=-7.5");
  CHECK(address.place() == "/dev/ttyUSB0");
  CHECK(address.has("baud"));
  CHECK(address.integer("baud", 38400, 0, 1000000) == 57600);
  CHECK(address.word("packet", "A1", {"A1", "N1"}) == "N1");
  CHECK(address.number("offset_deg", 0.0, -180.0, 180.0) == Approx(-7.5));
}

TEST_CASE("device address: what is no setting, or none of these values, is refused", "[drivers]") {
  CHECK(says(refusal([] { return read("x?speed=1"); }), "there are baud, packet, offset_deg"));
  CHECK(says(refusal([] { return (DeviceAddress{"x?a=1", {}}); }), "there are none"));
  CHECK(says(refusal([] { return read("x?"); }), "is no setting"));
  CHECK(says(refusal([] { return read("x?baud=1&"); }), "is no setting"));
  CHECK(says(refusal([] { return read("x?baud"); }), "needs a value"));
  CHECK(says(refusal([] { return read("x?baud="); }), "needs a value"));
  CHECK(says(refusal([] { return read("x?baud=1&baud=2"); }), "stands twice"));
  for (const char* text : {"baud=1x", "baud=-1", "baud=1e3", "baud=99999999999", "baud= 1"}) {
    INFO(text);
    CHECK(says(refusal([&] { return read(std::string{"x?"} + text).integer("baud", 1, 0, 1000); }),
               "must be a whole number from 0 to 1000"));
  }
  for (const char* text : {"nan", "inf", "181", "1.2.3", ""}) {
    INFO(text);
    CHECK_THROWS_AS(read(std::string{"x?offset_deg="} + text).number("offset_deg", 0, -180, 180),
                    StartupError);
  }
  CHECK(says(refusal([] {
               return read("x?packet=B1").word("packet", "A1", {"A1", "N1"});
             }),
             "must be one of A1, N1, not \"B1\""));
}
