// SPDX-License-Identifier: Apache-2.0
// Runs a program in a directory of its own and keeps what it said.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/catch.h"
#include "tests/support/text_of.h"

namespace lodesman::testing {

namespace fs = std::filesystem;

struct Outcome {
  int status = -1;
  std::string out;
  std::string error;
};

// A directory of its own for each row, in which the program runs.
class Bench {
 public:
  Bench() {
    std::string pattern = (fs::temp_directory_path() / "lodesman-refusals-XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    place_ = pattern;
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  ~Bench() { fs::remove_all(place_); }

  // Into a directory of that one, where the name has it.
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((place_ / name).parent_path());
    std::ofstream{place_ / name, std::ios::binary} << text;
    written_ += 1;
  }
  [[nodiscard]] Outcome run(const std::string& program, std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), program);
    std::vector<char*> argv;
    for (std::string& argument : arguments) {
      argv.push_back(argument.data());
    }
    argv.push_back(nullptr);
    const fs::path streams = place_.string() + ".streams";
    fs::create_directories(streams);
    const pid_t child = fork();
    if (child == 0) {
      constexpr unsigned kWatchdog_s = 60;
      const bool ready = chdir(place_.c_str()) == 0 &&
                         freopen((streams / "out").c_str(), "w", stdout) != nullptr &&
                         freopen((streams / "error").c_str(), "w", stderr) != nullptr;
      alarm(kWatchdog_s);
      if (ready) {
        execv(program.c_str(), argv.data());
      }
      _exit(127);
    }
    int status = 0;
    waitpid(child, &status, 0);
    Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
                    text_of(streams / "out"), text_of(streams / "error")};
    fs::remove_all(streams);
    return outcome;
  }
  // What the program left in a file; empty where there is none.
  [[nodiscard]] std::string left_in(const std::string& name) const {
    return text_of(place_ / name);
  }
  // Whether the program left anything behind.
  [[nodiscard]] bool untouched() const {
    return std::distance(fs::directory_iterator{place_}, fs::directory_iterator{}) == written_;
  }

 private:
  fs::path place_;
  std::ptrdiff_t written_ = 0;
};

}  // namespace lodesman::testing
