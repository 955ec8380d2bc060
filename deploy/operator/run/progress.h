// SPDX-License-Identifier: Apache-2.0
// Shows how far a run is: one line that is rewritten on a terminal, plain lines now and then
// elsewhere, nothing when it is to be quiet. It never waits for whoever reads it, and what it
// cannot write ends nothing. One thread.
#pragma once

#include <unistd.h>

#include <string>

#include "deploy/boat/nonblocking_stream.h"
#include "deploy/operator/run/watcher.h"
#include "mid_level/base/clock.h"

namespace lodesman::cli {

class ProgressLine {
 public:
  ProgressLine(const Scenario& scenario, bool quiet, int descriptor = STDERR_FILENO);
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  ~ProgressLine();  // leaves the cursor on a fresh line

  void show(const RunProgress& progress);
  // A line of its own, which stays.
  void say(const std::string& text);
  // The same, also for those who want quiet.
  void warn(const std::string& text);
  // Whether something could not be written at all. What nobody read in time does not count.
  [[nodiscard]] bool failed() const noexcept { return failed_; }

  // What show() writes, without its line end.
  [[nodiscard]] std::string line(const RunProgress& progress) const;

 private:
  void write(const std::string& text);

  std::string name_;
  double speed_m_s_;
  double whole_way_m_;
  bool quiet_;
  bool terminal_;
  bool line_open_ = false;
  bool failed_ = false;
  NonblockingStream stream_;
  Time started_;
  Time last_{};
};

}  // namespace lodesman::cli
