// SPDX-License-Identifier: Apache-2.0
// Reports as gpsd writes them, and a driver at the other end of a line in memory.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gpsd/gpsd_receiver.h"
#include "drivers/stream/memory_line.h"
#include "tests/support/catch.h"
#include "tests/support/fixes_now.h"

namespace lodesman::testing {

using std::chrono::milliseconds;
using std::chrono::seconds;

struct Told {
  int second = 0;  // after 2026-11-21 12:35:00
  double latitude_deg = 35.0272;
  double longitude_deg = 138.9;
  int mode = 3;
  int status = 0;
  double speed_m_s = 0.5;
  std::string date = "2026-11-21";
  std::string device = "/dev/pts/3";
};

[[nodiscard]] inline std::string tpv_line(const Told& told) {
  return fmt::format(
      R"({{"class":"TPV","device":"{}","status":{},"mode":{},"time":"{}T12:{:02}:{:02}.000Z",)"
      R"("lat":{:.9f},"lon":{:.9f},"track":54.7,"speed":{:.3f},"eph":17.1}})"
      "\r\n",
      told.device, told.status, told.mode, told.date, 35 + told.second / 60, told.second % 60,
      told.latitude_deg, told.longitude_deg, told.speed_m_s);
}

inline constexpr const char* kGreeting =
    R"({"class":"VERSION","release":"3.22","rev":"3.22","proto_major":3,"proto_minor":14})"
    "\r\n";
inline constexpr const char* kOneDevice =
    R"({"class":"DEVICES","devices":[{"class":"DEVICE","path":"/dev/pts/3","driver":"NMEA0183"}]})"
    "\r\n";
inline constexpr const char* kNoDevice = "{\"class\":\"DEVICES\",\"devices\":[]}\r\n";

// A gpsd at the far end; what it says arrives at once.
class Wired {
 public:
  explicit Wired(const std::string& device = "")
      : driver{line_->near_end(), GpsdOptions{"localhost:2947", device, Duration{}}} {
    static_cast<void>(driver.poll(now));  // what comes before it listens is lost
  }

  void say(std::string_view text) {
    for (const char letter : text) {
      REQUIRE(line_->send(static_cast<std::uint8_t>(letter), now));
    }
  }
  [[nodiscard]] std::string heard() {
    std::string text;
    std::array<std::uint8_t, 256> bytes{};
    const Received received = line_->receive(bytes, now);
    text.assign(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(received.count));
    return text;
  }
  void pass(Duration span) { now += span; }

  [[nodiscard]] std::vector<PositionFix> fixes() {
    return testing::fixes_now(driver, now, corrupt, last);
  }
  // What a report brings, and a second passes.
  [[nodiscard]] std::vector<PositionFix> fixes_of(const Told& told) {
    say(tpv_line(told));
    std::vector<PositionFix> given = fixes();
    pass(seconds{1});
    return given;
  }

  Time now{seconds{100}};
  std::unique_ptr<MemoryLine> line_ = std::make_unique<MemoryLine>();
  GpsdReceiver driver;
  ReadStatus last = ReadStatus::kNothingNew;
  int corrupt = 0;
};

}  // namespace lodesman::testing
