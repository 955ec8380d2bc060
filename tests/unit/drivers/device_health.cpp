// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/device_health.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
Time s(double seconds) { return Time{from_seconds(100.0 + seconds)}; }
}  // namespace

TEST_CASE("device health: what comes is counted, and since when it is so", "[drivers]") {
  DeviceHealthKeeper keeper{from_seconds(1)};
  CHECK(keeper.health().status == DeviceStatus::kAwaited);
  keeper.polled(ReadStatus::kNothingNew, false, s(0));
  CHECK(keeper.health().status == DeviceStatus::kAwaited);
  keeper.polled(ReadStatus::kFresh, true, s(0.1));
  CHECK(keeper.health().status == DeviceStatus::kWorking);
  CHECK(keeper.health().since == s(0.1));
  keeper.polled(ReadStatus::kFresh, true, s(0.2));
  CHECK(keeper.health().since == s(0.1));
  keeper.polled(ReadStatus::kCorrupt, false, s(0.3));
  CHECK(keeper.health().status == DeviceStatus::kCorrupt);
  keeper.polled(ReadStatus::kFresh, false, s(0.4));
  CHECK(keeper.health().status == DeviceStatus::kRefused);
  keeper.polled(ReadStatus::kDisconnected, false, s(0.5));
  keeper.polled(ReadStatus::kDisconnected, false, s(0.6));
  CHECK(keeper.health().status == DeviceStatus::kDisconnected);
  CHECK(keeper.health().since == s(0.5));
  CHECK(keeper.health().samples == 2);
  CHECK(keeper.health().corrupt == 1);
  CHECK(keeper.health().refused == 1);
  CHECK(keeper.health().disconnections == 1);
}

TEST_CASE("device health: one that never speaks, or no longer, is silent", "[drivers]") {
  DeviceHealthKeeper keeper{from_seconds(1)};
  for (const double t : {0.0, 0.5, 1.0}) {
    keeper.polled(ReadStatus::kNothingNew, false, s(t));
    CHECK(keeper.health().status == DeviceStatus::kAwaited);
  }
  keeper.polled(ReadStatus::kNothingNew, false, s(1.1));
  CHECK(keeper.health().status == DeviceStatus::kSilent);
  keeper.polled(ReadStatus::kFresh, true, s(2.0));
  keeper.polled(ReadStatus::kNothingNew, false, s(3.0));
  CHECK(keeper.health().status == DeviceStatus::kWorking);
  keeper.polled(ReadStatus::kNothingNew, false, s(3.1));
  CHECK(keeper.health().status == DeviceStatus::kSilent);
}

TEST_CASE("device health: it is told at each change, and once a second", "[drivers]") {
  DeviceHealthKeeper keeper{from_seconds(10)};
  keeper.commanded(CommandStatus::kTaken, s(0));
  CHECK(keeper.due(s(0)));
  CHECK_FALSE(keeper.due(s(0.1)));
  keeper.commanded(CommandStatus::kDisconnected, s(0.2));
  CHECK(keeper.due(s(0.2)));
  CHECK_FALSE(keeper.due(s(1.1)));
  CHECK(keeper.due(s(1.2)));
  keeper.absent(s(1.3));
  CHECK(keeper.due(s(1.3)));
  CHECK(keeper.health().status == DeviceStatus::kAbsent);
  keeper.commanded(CommandStatus::kNotReady, s(1.4));
  keeper.ails(DeviceFault::kProving);
  CHECK(keeper.due(s(1.4)));
  CHECK(keeper.health().status == DeviceStatus::kAwaited);
  CHECK(keeper.health().fault == DeviceFault::kProving);
  keeper.ails(DeviceFault::kProving);
  CHECK_FALSE(keeper.due(s(1.5)));
  keeper.ails(DeviceFault::kNoTimeOut);
  CHECK(keeper.due(s(1.6)));
}
