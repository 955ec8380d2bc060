// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "deploy/operator/watch/board_watch.h"
#include "mid_level/runtime/health.h"

namespace lodesman::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kRed = "\x1b[31m";
constexpr const char* kPlain = "\x1b[0m";

[[nodiscard]] const char* program_of(Role role) noexcept {
  switch (role) {
    case Role::kLow: return "low";
    case Role::kHigh: return "high";
    case Role::kNobody: break;
  }
  return "nobody";
}

[[nodiscard]] std::string seconds_or(const std::optional<double>& seconds, const char* otherwise) {
  return seconds ? fmt::format("{:.2f}", *seconds) : otherwise;
}

// The mark that says it without colour, and the colour where there is one.
[[nodiscard]] std::string marked(const std::string& line, bool wrong, bool colour) {
  const std::string with_mark = (wrong ? "! " : "  ") + line;
  return wrong && colour ? kRed + with_mark + kPlain : with_mark;
}

[[nodiscard]] std::string line_of(const ChannelRow& row) {
  return fmt::format("{:<18} {:<14} {:>6} {:>8} {:>6} {:>10} {:>7}", row.name, row.writer_task,
                     row.rate_hz ? fmt::format("{:.1f}", *row.rate_hz) : "-",
                     seconds_or(row.age_s, "never"),
                     row.max_age_s > 0.0 ? fmt::format("{:.1f}", row.max_age_s) : "-",
                     row.publications, row.missed);
}

[[nodiscard]] std::string line_of(const DeviceRow& row) {
  const std::string name = fmt::format("{:<11}", to_string(row.device));
  if (!row.health) {
    return name + " not told of";
  }
  const DeviceHealth& h = *row.health;
  return name + fmt::format(" {:<13} {:>8.1f} {:>10} {:>8} {:>8} {:>8}", to_string(h.status),
                            row.for_s, h.samples, h.corrupt, h.refused, h.disconnections);
}

[[nodiscard]] double in_us(std::uint64_t ns) noexcept { return static_cast<double>(ns) * 1e-3; }

// 99 of 100 steps began no later than this.
[[nodiscard]] double usual_late_us(const TaskHealth& health) noexcept {
  return to_seconds(late_at_most(health, 0.99)) * 1e6;
}

[[nodiscard]] std::string line_of(const TaskRow& row) {
  const std::string head =
      fmt::format("{:<12} {:<4} {:>4.0f}", row.name, program_of(row.process), row.period_s * 1e3);
  if (!row.health) {
    return head + "  not run";
  }
  const TaskHealth& health = *row.health;
  const std::string counts = head + fmt::format(" {:>4} {:>10} {:>8}", health.fifo_priority,
                                                health.steps, health.overruns);
  if (row.silent) {
    return counts + fmt::format("  silent for {:.1f} s", row.age_s.value_or(0.0));
  }
  return counts + fmt::format(" {:>10.1f} {:>9.1f} {:>9.1f}", in_us(health.worst_step_ns),
                              usual_late_us(health), in_us(health.worst_late_ns));
}

[[nodiscard]] Json number_or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

[[nodiscard]] Json json_of(const ChannelRow& row) {
  return {{"name", row.name},
          {"writer_task", row.writer_task},
          {"process", program_of(row.writer)},
          {"rate_hz", number_or_null(row.rate_hz)},
          {"age_s", number_or_null(row.age_s)},
          {"max_age_s", row.max_age_s > 0.0 ? Json(row.max_age_s) : Json(nullptr)},
          {"stale", row.stale},
          {"publications", row.publications},
          {"missed", row.missed},
          {"refused", row.refused}};
}

[[nodiscard]] Json json_of(const DeviceRow& row) {
  Json json{{"name", to_string(row.device)}};
  if (row.health) {
    const DeviceHealth& h = *row.health;
    json["status"] = to_string(h.status);
    json["for_s"] = row.for_s;
    json["samples"] = h.samples;
    json["corrupt"] = h.corrupt;
    json["refused"] = h.refused;
    json["disconnections"] = h.disconnections;
  }
  return json;
}

[[nodiscard]] Json json_of(const TaskRow& row) {
  const auto count = [&](std::uint64_t TaskHealth::*member) {
    return row.health ? Json((*row.health).*member) : Json(nullptr);
  };
  return {
      {"name", row.name},
      {"process", program_of(row.process)},
      {"period_s", row.period_s},
      {"steps", count(&TaskHealth::steps)},
      {"overruns", count(&TaskHealth::overruns)},
      {"refused", count(&TaskHealth::refused)},
      {"last_step_ns", count(&TaskHealth::last_step_ns)},
      {"worst_step_ns", count(&TaskHealth::worst_step_ns)},
      {"step_p99_us",
       row.health ? Json(to_seconds(took_at_most(*row.health, 0.99)) * 1e6) : Json(nullptr)},
      {"worst_late_ns", count(&TaskHealth::worst_late_ns)},
      {"late_p99_us", row.health ? Json(usual_late_us(*row.health)) : Json(nullptr)},
      {"wakes", count(&TaskHealth::wakes)},
      {"worst_wake_late_ns", count(&TaskHealth::worst_wake_late_ns)},
      {"wake_late_p99_us",
       row.health ? Json(to_seconds(wake_late_at_most(*row.health, 0.99)) * 1e6) : Json(nullptr)},
      {"over_budget", count(&TaskHealth::over_budget)},
      {"past_deadline", count(&TaskHealth::past_deadline)},
      {"fifo_priority", count(&TaskHealth::fifo_priority)},
      {"age_s", number_or_null(row.age_s)},
      {"silent", row.silent}};
}

[[nodiscard]] Json json_of(const PingToThrust& chain) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < kChainSteps; ++i) {
    steps.push_back({{"name", to_string(static_cast<ChainStep>(i))},
                     {"after_s", number_or_null(chain.after_s[i])}});
  }
  return {{"frame", chain.frame}, {"plan", chain.plan}, {"steps", std::move(steps)}};
}

// From capture to thrust, in the milliseconds after which each step was published.
void add_chain(std::vector<std::string>& lines, const PingToThrust& chain) {
  std::string head = fmt::format("  {:<9}", "ping to");
  std::string times = fmt::format("  {:<9}", "after ms");
  for (std::size_t i = 0; i < kChainSteps; ++i) {
    const auto& after_s = chain.after_s[i];
    head += fmt::format(" {:>{}}", to_string(static_cast<ChainStep>(i)), i == 1 ? 9 : 7);
    times += fmt::format(" {:>{}}", after_s ? fmt::format("{:.1f}", *after_s * 1e3) : "-",
                         i == 1 ? 9 : 7);
  }
  lines.push_back(head);
  lines.push_back(times);
}

// A line of its own where anything was: that is never as it should be.
void add_refused(std::vector<std::string>& lines, const char* name, std::uint64_t refused,
                 const char* what, bool colour) {
  if (refused > 0) {
    lines.push_back(marked(
        fmt::format("{}: {} {} were not sane and passed over", name, refused, what), true, colour));
  }
}

}  // namespace

std::vector<std::string> table_lines(const SegmentState& state, bool colour) {
  const auto life = [](bool alive) { return alive ? "alive" : "GONE"; };
  std::vector<std::string> lines;
  lines.push_back(marked(fmt::format("{}: lodesman-low {}, lodesman-high {}", state.segment,
                                     life(state.low_alive), life(state.high_alive)),
                         !state.low_alive || !state.high_alive, colour));
  lines.push_back(fmt::format("  {:<18} {:<14} {:>6} {:>8} {:>6} {:>10} {:>7}", "channel", "writer",
                              "Hz", "age s", "limit", "published", "missed"));
  for (const ChannelRow& row : state.board.channels) {
    lines.push_back(marked(line_of(row), row.stale, colour));
    add_refused(lines, row.name, row.refused, "publications", colour);
  }
  lines.push_back(fmt::format("  {:<11} {:<13} {:>8} {:>10} {:>8} {:>8} {:>8}", "device", "status",
                              "for s", "samples", "corrupt", "refused", "gone"));
  for (const DeviceRow& row : state.board.devices) {
    lines.push_back(marked(line_of(row), row.wrong, colour));
  }
  lines.push_back(fmt::format("  {:<12} {:<4} {:>4} {:>4} {:>10} {:>8} {:>10} {:>9} {:>9}", "task",
                              "in", "ms", "FIFO", "steps", "overruns", "longest us", "late 99 %",
                              "latest us"));
  for (const TaskRow& row : state.board.tasks) {
    lines.push_back(marked(line_of(row), row.silent, colour));
    add_refused(lines, row.name, row.health ? row.health->refused : 0, "inputs", colour);
  }
  if (state.board.chain) {
    add_chain(lines, *state.board.chain);
  }
  return lines;
}

Json to_json(const SegmentState& state) {
  Json channels = Json::array();
  for (const ChannelRow& row : state.board.channels) {
    channels.push_back(json_of(row));
  }
  Json devices = Json::array();
  for (const DeviceRow& row : state.board.devices) {
    devices.push_back(json_of(row));
  }
  Json tasks = Json::array();
  for (const TaskRow& row : state.board.tasks) {
    tasks.push_back(json_of(row));
  }
  return {{"segment", state.segment},
          {"low_alive", state.low_alive},
          {"high_alive", state.high_alive},
          {"channels", std::move(channels)},
          {"devices", std::move(devices)},
          {"tasks", std::move(tasks)},
          {"ping_to_thrust", state.board.chain ? json_of(*state.board.chain) : Json(nullptr)}};
}

}  // namespace lodesman::cli
