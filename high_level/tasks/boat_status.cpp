// SPDX-License-Identifier: Apache-2.0
#include "high_level/tasks/boat_status.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "high_level/tasks/thrust_desk.h"
#include "mid_level/base/heading.h"

namespace lodesman {
namespace {

using nlohmann::ordered_json;

void add_mission(const MissionStatus& m, Time now, ordered_json& reply) {
  reply["state"] = to_string(m.state);
  reply["cause"] = to_string(m.cause);
  reply["mission"] = m.mission;
  reply["speed_m_s"] = m.speed_m_s;
  reply["time_s"] = m.started == Time{} ? 0.0 : to_seconds(now - m.started);
  reply["goal_m"] = {m.goal_x_m, m.goal_y_m};
  reply["aborts"] = m.aborts;
  if (m.keeps_line) {
    reply["line"] = {{"begins_m", {m.line_begin_x_m, m.line_begin_y_m}},
                     {"cross_track_m", m.cross_track_m}};
  }
  if (m.blocked_since != Time{}) {
    reply["blocked"] = {{"for_s", to_seconds(now - m.blocked_since)}};
  }
  if (m.skipped > 0) {
    reply["skipped"] = m.skipped;
  }
  if (m.no_way != NoWayCause::kNone) {
    reply["no_way"] = {{"cause", to_string(m.no_way)}, {"for_s", to_seconds(now - m.no_way_since)}};
  }
}

}  // namespace

BoatStatus::BoatStatus(const Blackboard& board, bool arms_by_itself)
    : readiness_{board, arms_by_itself},
      mission_{board.mission_status},
      state_{board.vehicle_state},
      origin_{board.world_origin},
      plan_{board.plan},
      helm_{board.helm_command},
      thrust_{board.thrust_status},
      battery_{board.battery_status},
      guard_{board.guard_status} {}

void BoatStatus::add_to(ordered_json& reply, Time now) {
  if (const auto* mission = mission_.latest(); mission != nullptr) {
    add_mission(mission->value, now, reply);
    if (mission->value.state != MissionState::kUnderWay) {
      reply["not_ready"] = readiness_.reasons(now);
    }
  }
  if (std::vector<std::string> warnings = readiness_.warnings(); !warnings.empty()) {
    reply["warnings"] = std::move(warnings);
  }
  add_thrust(reply, now);
  add_guard(reply, now);
  add_place(reply, now);
  add_devices(reply, now);
}

void BoatStatus::add_thrust(ordered_json& reply, Time now) {
  if (const auto* thrust = thrust_.fresh(now, max_age::kThrustStatus); thrust != nullptr) {
    const ThrustStatus& t = thrust->value;
    const auto* box = readiness_.device(DeviceId::kThrusters);
    reply["thrust"] = {
        {"state", to_string(t.state)},
        {"cause", to_string(t.cause)},
        {"for_s", to_seconds(now - t.since)},
        {"against_arming", in_words(t.objections, box != nullptr ? &box->value : nullptr)}};
  }
  if (const auto* battery = battery_.fresh(now, max_age::kBatteryStatus);
      battery != nullptr && battery->value.volts > 0.0) {
    reply["battery"] = {{"level", to_string(battery->value.level)},
                        {"volts", battery->value.volts},
                        {"rest_volts", battery->value.rest_volts}};
  }
}

void BoatStatus::add_guard(ordered_json& reply, Time now) {
  const auto* guard = guard_.fresh(now, max_age::kGuardStatus);
  if (guard == nullptr) {
    return;
  }
  const GuardStatus& g = guard->value;
  reply["guard"] = {{"state", to_string(g.state)},
                    {"for_s", to_seconds(now - g.since)},
                    {"speed_m_s", g.speed_m_s},
                    {"trips", g.trips}};
  if (g.trips > 0) {
    reply["guard"]["last_trip"] = {{"reason", to_string(g.reason)},
                                   {"ago_s", to_seconds(now - g.tripped)},
                                   {"distance_m", g.distance_m},
                                   {"speed_m_s", g.trip_speed_m_s}};
  }
}

void BoatStatus::add_place(ordered_json& reply, Time now) {
  if (const auto* state = state_.latest(); state != nullptr) {
    reply["position_m"] = {state->value.x_m, state->value.y_m};
    reply["heading_deg"] = compass_deg(state->value.heading_rad);
    reply["state_age_s"] = to_seconds(now - state->stamp);
    reply["position_trust"] = to_string(state->value.trust);
    reply["position_sigma_m"] =
        std::sqrt(state->value.position_xx_m2 + state->value.position_yy_m2);
  }
  reply["origin"] = nullptr;  // until it is known
  if (const auto* origin = origin_.latest(); origin != nullptr) {
    reply["origin"] = {{"deg", {origin->value.latitude_deg, origin->value.longitude_deg}},
                       {"by", to_string(origin->value.source)}};
  }
  if (const auto* plan = plan_.latest(); plan != nullptr) {
    reply["plan"] = {{"id", plan->value.id},
                     {"reason", to_string(plan->value.reason)},
                     {"rung", to_string(plan->value.rung)},
                     {"waypoints", to_string(plan->value.source)},
                     {"age_s", to_seconds(now - plan->stamp)}};
    if (std::isfinite(plan->value.seen_ahead_m)) {
      reply["plan"]["seen_ahead_m"] = plan->value.seen_ahead_m;
    }
  }
  if (const auto* helm = helm_.latest(); helm != nullptr) {
    reply["helm"] = to_string(helm->value.reason);
  }
}

void BoatStatus::add_devices(ordered_json& reply, Time now) {
  for (std::size_t i = 0; i < kDeviceCount; ++i) {
    const auto id = static_cast<DeviceId>(i);
    if (const auto* health = readiness_.device(id); health != nullptr) {
      const DeviceHealth& h = health->value;
      reply["devices"][to_string(id)] = {
          {"status", to_string(h.status)}, {"for_s", to_seconds(now - h.since)},
          {"samples", h.samples},          {"corrupt", h.corrupt},
          {"refused", h.refused},          {"disconnections", h.disconnections}};
      if (h.fault != DeviceFault::kNone) {
        reply["devices"][to_string(id)]["fault"] = to_string(h.fault);
        reply["devices"][to_string(id)]["means"] = describe(h.fault);
      }
    }
  }
}

}  // namespace lodesman
