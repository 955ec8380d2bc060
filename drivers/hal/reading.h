// SPDX-License-Identifier: Apache-2.0
// What a poll of a device brings: every driver, simulated or real, answers in these words and
// never blocks. Called by the one thread that owns the device.
#pragma once

#include <cstdint>

namespace lodesman {

enum class ReadStatus : std::uint8_t {
  kFresh,         // a sample that was not given before
  kNothingNew,    // nothing complete since the last poll
  kCorrupt,       // bytes came that fail their check; the device may recover
  kDisconnected,  // the device is gone; it may come back
};

template <class S>
struct Reading {
  ReadStatus status = ReadStatus::kNothingNew;
  S sample{};  // valid only when kFresh
};

}  // namespace lodesman
