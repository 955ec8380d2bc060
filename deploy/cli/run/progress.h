// SPDX-License-Identifier: Apache-2.0
// Shows how far a run is: one line that is rewritten on a terminal, plain lines now and then
// elsewhere, nothing when it is to be quiet. Standard error; one thread.
#pragma once

#include <string>

#include "deploy/cli/run/watcher.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {

class ProgressLine {
 public:
  ProgressLine(const Scenario& scenario, bool quiet);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();  // leaves the cursor on a fresh line

  void show(const RunProgress& progress);
  // A line of its own, which stays.
  void say(const std::string& text);

 private:
  [[nodiscard]] std::string line(const RunProgress& progress) const;

  std::string name_;
  double speed_m_s_;
  double whole_way_m_;
  bool quiet_;
  bool terminal_;
  bool line_open_ = false;
  Time started_;
  Time last_{};
};

}  // namespace lodesman::cli
