// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/succession.h"

namespace lodesman {
namespace {

// Of one that was under way.
[[nodiscard]] Succession going_on(const Legacy& legacy) noexcept {
  if (legacy.silence > kLongestAbsence) {
    return {MissionState::kHolding, MissionCause::kAbsence};
  }
  const bool resumes = legacy.policy == OnRestart::kResume && !legacy.order_unanswered;
  return {resumes ? MissionState::kUnderWay : MissionState::kHolding, MissionCause::kRestart};
}

}  // namespace

Succession succession_of(const Legacy& legacy) noexcept {
  const MissionStatus& said = legacy.said;
  switch (said.state) {
    case MissionState::kIdle: return {};
    case MissionState::kAborted: return {said.state, said.cause};
    case MissionState::kReached:
    case MissionState::kUnderWay:
    case MissionState::kHolding: break;
  }
  if (!legacy.mission_is_known) {
    return {};
  }
  if (said.state == MissionState::kReached) {
    return {said.state, said.cause};
  }
  // As where the word came while it lived: after it the boat waits for an arm and for a start.
  if (legacy.thrusters_are_off) {
    return {MissionState::kAborted, MissionCause::kRestart};
  }
  return said.state == MissionState::kHolding ? Succession{said.state, said.cause}
                                              : going_on(legacy);
}

}  // namespace lodesman
