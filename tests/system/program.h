// SPDX-License-Identifier: Apache-2.0
// A program of this build, started as a shell starts it, in surroundings that a test chooses.
#pragma once

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/system/boat.h"

namespace lodesman::testing {

inline fs::path program_directory() { return fs::read_symlink("/proc/self/exe").parent_path(); }

// Puts a file in the place of a descriptor; for `surroundings` below.
inline void redirect(int descriptor, const char* file, int flags) {
  const int opened = open(file, flags, 0600);
  dup2(opened, descriptor);
  if (opened != descriptor) {
    close(opened);
  }
}

class Program {
 public:
  // `surroundings` is called in the child before the program: it may call the system and nothing
  // else. Standard output goes to standard error, so that a test's own stays readable.
  Program(
      const fs::path& program, std::vector<std::string> arguments,
      const std::function<void()>& surroundings = [] {}) {
    arguments.insert(arguments.begin(), program.string());
    std::vector<char*> words;
    for (std::string& argument : arguments) {
      words.push_back(argument.data());
    }
    words.push_back(nullptr);
    pid_ = fork();
    REQUIRE(pid_ >= 0);
    if (pid_ == 0) {
      dup2(STDERR_FILENO, STDOUT_FILENO);
      surroundings();
      execv(words.front(), words.data());
      _exit(127);
    }
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;
  ~Program() {
    if (!ended()) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
    }
  }

  [[nodiscard]] pid_t pid() const { return pid_; }
  // As a shell gives it: 128 and the signal's number where one ended it; empty while it runs.
  [[nodiscard]] const std::optional<int>& ended() {
    int status = 0;
    if (!status_ && waitpid(pid_, &status, WNOHANG) == pid_) {
      status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return status_;
  }
  // Waits for it; -1 where it goes on for longer than anybody should wait.
  [[nodiscard]] int status(Duration patience = seconds{60}) {
    return eventually([&] { return ended().has_value(); }, patience) ? *status_ : -1;
  }

 private:
  pid_t pid_ = -1;
  std::optional<int> status_;
};

inline fs::path program(const std::string& name) { return program_directory() / name; }

// Arguments of a run whose command socket takes no port that another test may want.
inline std::vector<std::string> sim(const fs::path& scenario, const fs::path& out,
                                    std::vector<std::string> more = {}) {
  std::vector<std::string> arguments{
      "sim",   scenario.string(),      "--out", out.string(), "--no-images",
      "--set", "command_socket.port=0"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// The segment of a run, once its thrusters drive.
inline SharedBlackboard under_way(const Program& launcher) {
  auto board =
      SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()), seconds{20});
  Reader<ThrustApplied> thrust{board->thrust_applied};
  REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  return board;
}

}  // namespace lodesman::testing
