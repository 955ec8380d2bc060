// SPDX-License-Identifier: Apache-2.0
// The emergency stop's latch, kept where it outlives the power: a file of one word beside the
// boat's state. The main thread of lodesman-low.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "mid_level/messages/arming.h"

namespace lodesman {

enum class Latch : std::uint8_t {
  kClear,
  kStopped,     // the emergency stop stood when the power went
  kUnreadable,  // nobody knows: the thrusters begin disarmed, whatever else remembers
};

class LatchFile {
 public:
  // For the boat of that segment: in what the service manager names (STATE_DIRECTORY), else in
  // /var/lib/lodesman for root, else in the user's own directory for state. Empty where there is
  // none of these.
  [[nodiscard]] static std::optional<std::filesystem::path> place_for(const std::string& segment);

  explicit LatchFile(std::filesystem::path file) : file_{std::move(file)} {}

  [[nodiscard]] Latch read() const;
  // Brings the file up to what the thruster task says; once a change. What could not be written is
  // said, once; and tried again at the next look.
  [[nodiscard]] std::optional<std::string> follow(const ThrustStatus& status);

 private:
  [[nodiscard]] bool write() const;
  [[nodiscard]] bool remove() const;

  std::filesystem::path file_;
  std::optional<bool> written_;  // what the file says
  bool complained_ = false;
};

}  // namespace lodesman
