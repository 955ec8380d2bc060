// SPDX-License-Identifier: Apache-2.0
// Another package's program beside this one, with all that it starts itself: neither outlives this
// object, nor this process where that can be helped. One thread.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "mid_level/base/time.h"

namespace lodesman::cli {

// Where a program is found by its name; empty where it is not installed.
[[nodiscard]] std::filesystem::path find_program(const std::string& name);

class Companion {
 public:
  // Runs in `directory`, in a process group of its own; what it says goes to the file `said` there.
  // The kernel sends it SIGTERM when this process dies. Throws StartupError where it cannot begin.
  Companion(const std::vector<std::string>& words, const std::filesystem::path& directory);
  Companion(const Companion&) = delete;
  Companion& operator=(const Companion&) = delete;
  ~Companion();  // stops it

  // Whether it has ended by itself.
  [[nodiscard]] bool ended();
  // Asks all of its group to end, and kills what has not after `patience`.
  void stop(Duration patience);
  // The last line that it said; empty where it said nothing.
  [[nodiscard]] std::string last_words() const;

 private:
  std::filesystem::path said_;
  pid_t pid_ = -1;
  bool waited_for_ = false;
};

}  // namespace lodesman::cli
