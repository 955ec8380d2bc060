// SPDX-License-Identifier: Apache-2.0
// A unit of the family to test the driver against, in so many words as the tests need, at the far
// end of a line in memory. It goes on by milliseconds; what it does amiss is told by its members.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "drivers/nav440/nav440.h"
#include "drivers/stream/memory_line.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {

inline constexpr Time kUnitOn{std::chrono::seconds{100}};
[[nodiscard]] constexpr Time after(double seconds) { return kUnitOn + from_seconds(seconds); }

// What it measures at a time, as its packets count: 65536 to a turn, and to 1260 degrees a second.
struct Motion {
  double yaw_deg = 0.0;  // of true north
  double yaw_rate_deg_s = 0.0;
};

// Where its receiver puts it; as it stands, what a unit says that never had a fix.
struct Whereabouts {
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double north_m_s = 0.0;
  double east_m_s = 0.0;
};

class ScriptedUnit {
 public:
  explicit ScriptedUnit(MemoryLine& line) : line_{line} {}

  void go_on_to(Time now);
  void power_cycle();
  // As another program would.
  void speak_at(int baud) { baud_ = baud; }

  // What it keeps without power.
  int stored_baud = 57600;
  int stored_divider = 2;
  std::string stored_type = "A1";
  // What it does.
  bool has_speed = true;  // bytes take their time, and the wrong speed garbles them
  std::function<Motion(Time)> motion = [](Time) { return Motion{}; };
  std::function<Whereabouts(Time)> place = [](Time) { return Whereabouts{}; };  // of N0 and N1
  bool flickers = true;          // as real ones do, in accelerations and rates
  double declination_deg = 0.0;  // where it is: yaw of A0 and A1 is magnetic
  std::uint16_t bit = 0;
  std::int64_t time_off_ms = 0;  // added to its time
  bool time_stands = false;
  double clock_ppm = 0.0;  // how much too slow it is
  Duration batch{};        // what it says is let go at multiples of this
  bool is_frozen = false;
  bool is_dead = false;
  // What it does amiss.
  int drops_reply = 0;         // each of so many; 0: none
  bool ignores_speed = false;  // says that it took a new one, and did not
  std::string refuses_type;    // as a continuous packet
  bool has_identity = true;
  bool has_version = true;
  bool is_foreign = false;  // streams and refuses as an OpenIMU
  Duration reply_delay = std::chrono::milliseconds{2};
  std::function<void(ByteList&)> damage = [](ByteList&) {};  // of each packet of the stream
  // What it was told.
  int pings = 0;
  int sets = 0;
  int writes = 0;
  std::uint64_t packets = 0;  // sent of the stream

  [[nodiscard]] int baud() const { return baud_; }
  [[nodiscard]] int divider() const { return divider_; }
  [[nodiscard]] const std::string& type() const { return type_; }

 private:
  void listen();
  void obey(const Kept& request);
  void set(const Kept& request);
  void get(const Kept& request);
  [[nodiscard]] bool accepts(unsigned id, unsigned value) const;
  void apply(unsigned id, unsigned value);
  [[nodiscard]] unsigned field(unsigned id) const;
  void reply(const ByteList& frame);
  void stream();
  [[nodiscard]] ByteList payload(Time measured);
  void say(ByteList bytes, Time from);

  MemoryLine& line_;
  Nav440Framing framing_;  // tested apart, by the vectors
  Time now_ = kUnitOn;
  Time busy_until_{};
  std::int64_t tick_ms_ = 0;
  int baud_ = stored_baud;
  int divider_ = stored_divider;
  std::string type_ = stored_type;
  int replies_ = 0;
  ByteList frozen_;
  unsigned noise_ = 1;
};

// The driver, its line and its unit, on one time.
struct UnitBench {
  explicit UnitBench(Nav440Options wanted = {}) : options{wanted} {}

  Nav440Options options;
  Nav440FixRelay fixes;
  std::unique_ptr<MemoryLine> line = std::make_unique<MemoryLine>();
  ScriptedUnit unit{*line};
  std::unique_ptr<Nav440> driver;  // made with the first step
  Time now = kUnitOn;
  Duration period = std::chrono::milliseconds{5};  // of polls
  std::vector<Attitude> samples;
  std::vector<Time> given;  // when each was
  int corrupt = 0;          // polls that said so
  int disconnected = 0;

  void step();
  void run(double seconds);
  // Runs until it streams and gives samples; false where it does not come to that in time.
  [[nodiscard]] bool comes_up(double within_s = 5.0);
  [[nodiscard]] DeviceFault fault() const { return driver->fault(); }
};

[[nodiscard]] Motion turning(Time at, double rate_deg_s);

// How far headings are off what the unit did at their stamps.
[[nodiscard]] double worst_error_deg(const UnitBench& bench, std::size_t from = 0);

}  // namespace lodesman::testing
