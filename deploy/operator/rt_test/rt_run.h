// SPDX-License-Identifier: Apache-2.0
// Runs the boat's two programs on simulated devices in real time, with a load and with cyclictest
// beside them, and looks at them twice. The caller's thread; everything is ended again, however
// this ends.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "deploy/boat/configuration.h"
#include "deploy/operator/rt_test/rt_report.h"

namespace lodesman::cli {

struct RtRunOptions {
  const BoatConfig& configuration;
  std::string scenario_text;
  std::filesystem::path place;  // a directory for its files
  LoadKind load = LoadKind::kIdle;
  double seconds = 0.0;  // to be looked at
  bool cyclictest = false;
  const std::function<bool()>& interrupted;
  // Called now and then with how many of the seconds are over.
  const std::function<void(double)>& show;
};

struct RtRunOutcome {
  std::optional<RtReport> report;  // nothing where there was not enough to look at
  std::string fault;               // what ended it, if something did
};

// Throws StartupError where something cannot be started: then nothing was measured.
[[nodiscard]] RtRunOutcome run_rt_test(const RtRunOptions& options);

}  // namespace lodesman::cli
