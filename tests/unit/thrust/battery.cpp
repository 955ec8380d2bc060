// SPDX-License-Identifier: Apache-2.0
#include "low_level/thrust/battery.h"

#include <limits>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;
using std::chrono::seconds;

namespace {

constexpr BatteryOptions kOptions{23.0, 22.0, 0.5, 1.5};

struct Battery {
  BatteryMonitor monitor{kOptions};
  Time now{seconds{100}};
  int alarms = 0;

  void give(double volts, double load, Duration span) {
    for (const Time end = now + span; now < end;) {
      now += milliseconds{100};
      const BatteryLevel before = monitor.status().level;
      monitor.look(volts, now, load, now);
      alarms += monitor.status().level != before && monitor.status().level != BatteryLevel::kGood;
    }
  }
};

}  // namespace

TEST_CASE("battery: without limits or readings nothing is known", "[thrust]") {
  BatteryMonitor none{{}};
  none.look(25.0, Time{seconds{1}}, 0.0, Time{seconds{1}});
  CHECK(none.status().level == BatteryLevel::kUnknown);
  CHECK(none.status().volts == Approx(25.0));
  BatteryMonitor silent{kOptions};
  silent.look(0.0, Time{}, 0.0, Time{seconds{1}});
  CHECK(silent.status().level == BatteryLevel::kUnknown);
}

TEST_CASE("P1: sag and noise about a limit give one alarm", "[thrust]") {
  Battery bench;
  bench.give(25.2, 0.0, seconds{5});
  CHECK(bench.monitor.status().level == BatteryLevel::kGood);
  bench.give(25.2 - 1.5, 1.0, seconds{60});  // full thrust: the sag is no discharge
  CHECK(bench.monitor.status().level == BatteryLevel::kGood);
  CHECK(bench.monitor.status().rest_volts == Approx(25.2));
  CHECK(bench.alarms == 0);
  bench.give(22.9, 0.0, seconds{60});
  CHECK(bench.monitor.status().level == BatteryLevel::kLow);
  for (int i = 0; i < 60; ++i) {  // 1 Hz about the limit
    bench.give(22.8, 0.0, milliseconds{500});
    bench.give(23.2, 0.0, milliseconds{500});
  }
  CHECK(bench.monitor.status().level == BatteryLevel::kLow);
  CHECK(bench.alarms == 1);
  bench.give(24.5, 0.0, seconds{60});
  CHECK(bench.monitor.status().level == BatteryLevel::kGood);
}

TEST_CASE("battery: critical is latched, and silence is unknown", "[thrust]") {
  Battery bench;
  bench.give(24.0, 0.0, seconds{5});
  bench.monitor.look(24.0, bench.now, 0.0, bench.now + BatteryMonitor::kSilence_max);
  CHECK(bench.monitor.status().level == BatteryLevel::kGood);
  bench.monitor.look(24.0, bench.now, 0.0,
                     bench.now + BatteryMonitor::kSilence_max + milliseconds{1});
  CHECK(bench.monitor.status().level == BatteryLevel::kUnknown);
  bench.now += seconds{10};
  bench.give(21.0, 0.0, seconds{60});
  CHECK(bench.monitor.status().level == BatteryLevel::kCritical);
  bench.give(25.2, 0.0, seconds{600});
  CHECK(bench.monitor.status().level == BatteryLevel::kCritical);
}

TEST_CASE("battery: what is no voltage is passed over", "[thrust]") {
  Battery bench;
  bench.give(24.0, 0.0, seconds{5});
  for (const double volts : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity()}) {
    bench.monitor.look(volts, bench.now + milliseconds{1}, 0.0, bench.now + milliseconds{1});
    CHECK(bench.monitor.status().rest_volts == Approx(24.0));
  }
}
