// SPDX-License-Identifier: Apache-2.0
// One number for everything that was published: two runs that agree in it made the same decisions.
// Fed after every step of the lock-step runner; one thread.
#pragma once

#include <memory>
#include <string>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

class RecordingHash {
 public:
  explicit RecordingHash(const Blackboard& board);
  RecordingHash(const RecordingHash&) = delete;
  RecordingHash& operator=(const RecordingHash&) = delete;
  ~RecordingHash();

  // Takes in what was published since the last call, channel by channel in the blackboard's order:
  // the channel, stamp, sequence and each field; no padding, no measured wall times.
  void update() noexcept;

  // 32 hexadecimal digits (XXH3, 128 bits).
  [[nodiscard]] std::string digest() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
