// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/commander.h"

#include <cmath>

namespace lodesman {

std::string Commander::who(Time now) const {
  const auto for_s = static_cast<long>(std::lround(to_seconds(now - link_.opened)));
  return (name_.empty() ? "another session" : "\"" + name_ + "\"") + " for " +
         std::to_string(for_s) + " s";
}

std::optional<std::string> Commander::objection(std::uint64_t session, Time now) const {
  if (!commands(now) || link_.session == session) {
    return std::nullopt;
  }
  return "command is held by " + who(now) + ": it must release it, or you take it by force";
}

std::optional<std::string> Commander::take(std::uint64_t session, const std::string& name,
                                           bool force, Time now) {
  if (auto no = objection(session, now); no && !force) {
    return no;
  }
  if (link_.session != session) {
    link_ = {session, now, now};
  }
  name_ = name;
  gone_ = false;
  return beat(session, now);
}

std::optional<std::string> Commander::beat(std::uint64_t session, Time now) {
  if (link_.session != session) {
    return link_.session == 0 ? "nobody commands: take command first"
                              : "command is held by " + who(now);
  }
  link_.heard = now;
  return std::nullopt;
}

std::optional<std::string> Commander::release(std::uint64_t session) {
  if (link_.session != session) {
    return "you do not command";
  }
  link_ = {};
  name_.clear();
  gone_ = false;
  return std::nullopt;
}

void Commander::ended(std::uint64_t session) noexcept { gone_ |= link_.session == session; }

void Commander::forget_the_lost(Time now) noexcept {
  if (!commands(now)) {
    link_ = {};
    name_.clear();
    gone_ = false;
  }
}

}  // namespace lodesman
