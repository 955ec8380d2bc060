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
  // Starts a program that lies beside this one. Its standard output is this process's standard
  // error. Its standard input is a pipe that ends when this process does, however that dies; the
  // kernel sends it SIGTERM too, but only to a program that gains no rights by being run. Throws
  // StartupError when it cannot be run.
  ChildProcess(const std::string& program, const std::vector<std::string>& arguments);
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;
  ~ChildProcess();  // stops it, within 2 s

  [[nodiscard]] const std::string& name() const noexcept { return name_; }
  [[nodiscard]] pid_t pid() const noexcept { return pid_; }
  // How it ended ("exit status 4", "signal 9"); empty while it runs. Never an end that is missed:
  // a child that somebody else has waited for is gone.
  [[nodiscard]] const std::optional<std::string>& ended();
  // Empty while it runs, and where it did not exit by itself.
  [[nodiscard]] std::optional<int> exit_status() const noexcept { return exit_status_; }
  // One beat down its standard input, for a child that is to notice when this process falls silent.
  // Any thread, as long as this object lives; never waits, whatever the child does.
  void beat() const noexcept;
  // Asks it to end, and kills it when it has not after `patience`.
  void stop(Duration patience);

 private:
  std::string name_;
  pid_t pid_ = -1;
  int life_line_ = -1;  // the pipe's other end
  std::optional<std::string> ended_;
  std::optional<int> exit_status_;
};

}  // namespace lodesman::cli
