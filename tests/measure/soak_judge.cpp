// SPDX-License-Identifier: Apache-2.0
#include "tests/measure/soak_judge.h"

#include <fmt/format.h>

#include <cmath>

namespace lodesman::measure {
namespace {

constexpr Duration kStop = std::chrono::seconds{30};
constexpr double kWay_m = 1.0;                                    // is way, in that time
constexpr Duration kSaid_max = std::chrono::seconds{15};          // ago: the boat's own patience
constexpr double kGrowth_max_kib = 2048.0;                        // once it has settled
constexpr std::uint64_t kSequence_max = std::uint64_t{1} << 32U;  // far below what wraps

}  // namespace

std::vector<std::string> objections(const SoakFigures& figures) {
  std::vector<std::string> reasons;
  if (figures.unsaid > 0) {
    reasons.push_back(fmt::format("stood still {} times without saying why", figures.unsaid));
  }
  const double grown_kib = figures.last.resident_kib - figures.settled.resident_kib;
  if (grown_kib >= kGrowth_max_kib) {
    reasons.push_back(fmt::format("grew by {:.0f} KiB", grown_kib));
  }
  if (figures.last.descriptors > figures.settled.descriptors) {
    reasons.push_back(fmt::format("holds {} descriptors more",
                                  figures.last.descriptors - figures.settled.descriptors));
  }
  if (figures.highest_sequence >= kSequence_max) {
    reasons.push_back(fmt::format("counted as far as {}", figures.highest_sequence));
  }
  return reasons;
}

SoakJudge::SoakJudge(const Blackboard& board)
    : truth_{board.world_truth},
      mission_{board.mission_status},
      plan_{board.plan},
      helm_{board.helm_command},
      thrust_{board.thrust_applied} {}

void SoakJudge::begin_leg(Time now) {
  leg_ = {};
  said_.clear();
  said_at_ = Time{};
  lay_ = at_;
  lay_since_ = now;
}

void SoakJudge::look(Time now) {
  // First of all: whether a contact is one under way is for the mission of now to say.
  if (const auto* mission = mission_.latest()) {
    status_ = mission->value;
  }
  while (const auto* truth = truth_.next()) {
    at_ = truth->value;
    note_contact(at_);
  }
  if (const auto* plan = plan_.latest()) {
    rung_ = plan->value.rung;
  }
  if (const auto* helm = helm_.latest()) {
    helm_reason_ = helm->value.reason;
  }
  if (const auto* thrust = thrust_.latest()) {
    thrust_reason_ = thrust->value.reason;
  }
  if (const std::string why = reason(); !why.empty()) {
    said_ = why;
    said_at_ = now;
  }
  note_stop(now);
}

void SoakJudge::note_contact(const WorldTruth& truth) {
  const bool touches = truth.inoffensive_distance_m < 0.0 || truth.hull_clearance_m < 0.0;
  if (touches && !touches_) {
    ++(status_.state == MissionState::kUnderWay ? leg_.contacts : leg_.contacts_at_rest);
  }
  touches_ = touches;
}

void SoakJudge::note_stop(Time now) {
  if (status_.state != MissionState::kUnderWay ||
      std::hypot(at_.x_m - lay_.x_m, at_.y_m - lay_.y_m) > kWay_m) {
    lay_ = at_;
    lay_since_ = now;
  } else if (now - lay_since_ >= kStop) {
    ++leg_.stops;
    leg_.unsaid += said_at_ == Time{} || now - said_at_ > kSaid_max ? 1U : 0U;
    lay_since_ = now;
  }
}

// What the boat says of itself at this moment that makes it stand still; empty where it sails.
std::string SoakJudge::reason() const {
  if (status_.no_way != NoWayCause::kNone) {
    return std::string{"no way: "} + to_string(status_.no_way);
  }
  if (status_.state != MissionState::kUnderWay) {
    return "";
  }
  if (thrust_reason_ != ThrustReason::kCommanded) {
    return std::string{"thrust: "} + to_string(thrust_reason_);
  }
  if (helm_reason_ != HelmReason::kTracking) {
    return std::string{"helm: "} + to_string(helm_reason_);
  }
  const bool waits = rung_ == PlanRung::kStop || rung_ == PlanRung::kHold ||
                     rung_ == PlanRung::kNearGoal || rung_ == PlanRung::kBestPoint ||
                     rung_ == PlanRung::kNothing;
  return waits ? std::string{"plan: "} + to_string(rung_) : "";
}

LegOutcome SoakJudge::end_leg(double goal_x_m, double goal_y_m, const std::string& refusal) {
  LegOutcome leg = leg_;
  leg.to_go_m = std::hypot(at_.x_m - goal_x_m, at_.y_m - goal_y_m);
  if (!refusal.empty()) {
    leg.what = "not started: " + refusal;
  } else if (status_.state == MissionState::kReached) {
    leg.what = "reached";
  } else if (status_.state != MissionState::kUnderWay) {
    leg.what = to_string(status_.state);
  } else {
    leg.what = said_.empty() ? "out of time, under way" : "out of time; last said " + said_;
  }
  return leg;
}

}  // namespace lodesman::measure
