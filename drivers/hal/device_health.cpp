// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/device_health.h"

namespace lodesman {

void DeviceHealthKeeper::polled(ReadStatus status, bool sane, Time now) noexcept {
  switch (status) {
    case ReadStatus::kNothingNew:
      if (heard_ == Time{}) {
        heard_ = now;  // from here on it could have spoken
      } else if (now - heard_ > silence_limit_) {
        become(DeviceStatus::kSilent, now);
      }
      return;
    case ReadStatus::kFresh:
      ++(sane ? health_.samples : health_.refused);
      become(sane ? DeviceStatus::kWorking : DeviceStatus::kRefused, now);
      break;
    case ReadStatus::kCorrupt:
      ++health_.corrupt;
      become(DeviceStatus::kCorrupt, now);
      break;
    case ReadStatus::kDisconnected:
      health_.disconnections += health_.status != DeviceStatus::kDisconnected ? 1 : 0;
      become(DeviceStatus::kDisconnected, now);
      break;
  }
  heard_ = now;
}

void DeviceHealthKeeper::commanded(CommandStatus status, Time now) noexcept {
  switch (status) {
    case CommandStatus::kTaken: polled(ReadStatus::kFresh, true, now); break;
    case CommandStatus::kNotReady: become(DeviceStatus::kAwaited, now); break;
    case CommandStatus::kDisconnected: polled(ReadStatus::kDisconnected, true, now); break;
  }
}

bool DeviceHealthKeeper::due(Time now) noexcept {
  if (!changed_ && now - told_ < kTellPeriod) {
    return false;
  }
  changed_ = false;
  told_ = now;
  return true;
}

void DeviceHealthKeeper::become(DeviceStatus status, Time now) noexcept {
  if (health_.status != status || health_.since == Time{}) {
    health_.status = status;
    health_.since = now;
    changed_ = true;
  }
}

}  // namespace lodesman
