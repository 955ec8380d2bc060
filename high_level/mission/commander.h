// SPDX-License-Identifier: Apache-2.0
// Who commands the boat: one session at a time, for as long as its heartbeat is heard. It is handed
// everything it needs; one thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "mid_level/base/time.h"
#include "mid_level/messages/mission.h"

namespace lodesman {

// A commander whose heartbeat (1 Hz) was not heard for so long commands no more.
inline constexpr Duration kCommanderPatience = std::chrono::seconds{3};

class Commander {
 public:
  // Why this session may not order anything now; empty when it may. Nobody has to take command
  // while nobody else has it.
  [[nodiscard]] std::optional<std::string> objection(std::uint64_t session, Time now) const;

  // Takes command; from somebody who has it only by `force`. Gives the objection, if there is one.
  std::optional<std::string> take(std::uint64_t session, const std::string& name, bool force,
                                  Time now);
  // Of the commander; anybody else's is refused with the reason.
  std::optional<std::string> beat(std::uint64_t session, Time now);
  std::optional<std::string> release(std::uint64_t session);
  // The connection is gone: what it did not release it lost.
  void ended(std::uint64_t session) noexcept;
  // A start was ordered by a session that does not command: no old link is watched for it.
  void forget_the_lost(Time now) noexcept;

  [[nodiscard]] const CommandLink& link() const noexcept { return link_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] bool commands(Time now) const noexcept {
    return link_.session != 0 && !gone_ && now - link_.heard <= kCommanderPatience;
  }

 private:
  [[nodiscard]] std::string who(Time now) const;

  CommandLink link_;
  std::string name_;
  bool gone_ = false;
};

}  // namespace lodesman
