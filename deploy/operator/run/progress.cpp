// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/progress.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "deploy/operator/run/way_left.h"

namespace lodesman::cli {
namespace {

constexpr int kBarWidth = 24;
constexpr Duration kTerminalPeriod = std::chrono::milliseconds{100};
constexpr Duration kPlainPeriod = std::chrono::seconds{10};

}  // namespace

ProgressLine::ProgressLine(const Scenario& scenario, bool quiet, int descriptor)
    : name_{scenario.name},
      speed_m_s_{scenario.speed_m_s},
      whole_way_m_{way_left_m(scenario.mission, 0, scenario.mission.start.p_WV)},
      quiet_{quiet},
      terminal_{isatty(descriptor) == 1},
      stream_{descriptor},
      started_{SteadyClock{}.now()} {}

ProgressLine::~ProgressLine() {
  if (line_open_) {
    write("\n");
  }
}

void ProgressLine::show(const RunProgress& progress) {
  const Time now = SteadyClock{}.now();
  const Duration period = terminal_ ? kTerminalPeriod : kPlainPeriod;
  if (quiet_ || (last_ != Time{} && now - last_ < period)) {
    return;
  }
  last_ = now;
  write(terminal_ ? "\r" + line(progress) + "\x1b[K" : line(progress) + "\n");
  line_open_ = terminal_;
}

void ProgressLine::say(const std::string& text) {
  if (!quiet_) {
    warn(text);
  }
}

void ProgressLine::warn(const std::string& text) {
  write((terminal_ ? "\r\x1b[K" : "") + text + "\n");
  line_open_ = false;
}

void ProgressLine::write(const std::string& text) {
  failed_ = stream_.write(text) == NonblockingStream::Written::kFailed || failed_;
}

std::string ProgressLine::line(const RunProgress& progress) const {
  if (progress.state == MissionState::kIdle) {
    return fmt::format("{}  waiting for the start", name_);
  }
  const double done = std::clamp(1.0 - progress.to_go_m / std::max(whole_way_m_, 0.1), 0.0, 1.0);
  const auto filled = static_cast<std::size_t>(std::lround(done * kBarWidth));
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  const double wall_s = std::max(to_seconds(SteadyClock{}.now() - started_), 0.01);
  const double rate = progress.scenario_time_s / wall_s;
  const double left_s = progress.to_go_m / std::max(speed_m_s_, 0.01) / std::max(rate, 0.01);
  std::string text =
      fmt::format("{}  [{}] {:5.1f} s  {:.1f}x  ~{:.0f} s left  ({:.1f}, {:.1f}) m", name_, bar,
                  progress.scenario_time_s, rate, left_s, progress.truth.x_m, progress.truth.y_m);
  if (std::isfinite(progress.truth.inoffensive_distance_m)) {
    text += fmt::format("  ID {:.2f} m", progress.truth.inoffensive_distance_m);
  }
  if (progress.last_plan) {
    text +=
        fmt::format("  plan {} {}", progress.last_plan->id, to_string(progress.last_plan->reason));
  }
  return text;
}

}  // namespace lodesman::cli
