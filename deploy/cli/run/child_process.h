// SPDX-License-Identifier: Apache-2.0
// A program started beside this one that cannot outlive it. One thread.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman::cli {

class ChildProcess {
 public:
  // Starts a program that lies beside this one; the kernel ends it when this process dies. Its
  // standard output is this process's standard error. Throws StartupError when it cannot be run.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  // stops it

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  // How it ended ("exit status 4", "signal 9"); empty while it runs.
  [[nodiscard]] const std::optional<std::string>& ended();
  // Asks it to end, and kills it when it has not after `patience`.
  void stop(Duration patience);

 private:
  std::string name_;
  pid_t pid_ = -1;
  std::optional<std::string> ended_;
};

}  // namespace lodesman::cli
