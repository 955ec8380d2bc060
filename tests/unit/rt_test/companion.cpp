// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/companion.h"

#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <thread>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Scratch {
 public:
  Scratch() {
    std::string pattern = (fs::temp_directory_path() / "lodesman-companion-XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { fs::remove_all(path_); }
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// The numbers of processes that a shell has written there, one a line.
std::vector<pid_t> numbers_in(const fs::path& file, std::size_t count) {
  std::vector<pid_t> numbers;
  while (numbers.size() < count) {
    numbers.clear();
    std::ifstream lines{file};
    for (pid_t number = 0; lines >> number;) {
      numbers.push_back(number);
    }
    std::this_thread::sleep_for(milliseconds{2});
  }
  return numbers;
}

bool is_gone(pid_t process) {
  for (int i = 0; i < 5000; ++i) {
    std::ifstream stat{"/proc/" + std::to_string(process) + "/stat"};
    std::string number;
    std::string name;
    std::string state;
    // A child that nobody has waited for yet runs no more.
    if (!(stat >> number >> name >> state) || state == "Z") {
      return true;
    }
    std::this_thread::sleep_for(milliseconds{2});
  }
  return false;
}

}  // namespace

TEST_CASE("companion: it ends with all that it has started", "[operator][rt_test]") {
  const Scratch scratch;
  std::vector<pid_t> processes;
  {
    // One that heeds no request to end, and one that does.
    const Companion shell{
        {"sh", "-c",
         "sh -c 'trap : TERM; echo $$ >>pids; while :; do sleep 1; done' & echo $! >>pids; "
         "echo $$ >>pids; wait"},
        scratch.path()};
    processes = numbers_in(scratch.path() / "pids", 3);
  }
  for (const pid_t process : processes) {
    INFO(process);
    CHECK(is_gone(process));
  }
}

TEST_CASE("companion: its last words are kept", "[operator][rt_test]") {
  const Scratch scratch;
  Companion shell{{"sh", "-c", "echo first; echo 'not allowed' >&2; exit 3"}, scratch.path()};
  while (!shell.ended()) {
    std::this_thread::sleep_for(milliseconds{2});
  }
  CHECK(shell.last_words() == "not allowed");
  shell.stop(seconds{1});  // twice is once
  CHECK(shell.ended());
}

TEST_CASE("companion: what is not installed is refused", "[operator][rt_test]") {
  const Scratch scratch;
  CHECK(find_program("lodesman-no-such-program").empty());
  CHECK_THROWS_AS(Companion({"lodesman-no-such-program"}, scratch.path()), StartupError);
}

}  // namespace lodesman::cli
