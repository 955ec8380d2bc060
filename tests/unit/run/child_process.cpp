// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/child_process.h"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/system/boat.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

// A script beside this program, where children are looked for; gone with the test.
class Script {
 public:
  explicit Script(const std::string& text)
      : name_{"test-child-" + std::to_string(getpid())},
        file_{fs::read_symlink("/proc/self/exe").parent_path() / name_} {
    std::ofstream{file_} << "#!/bin/sh\n" << text << "\n";
    fs::permissions(file_, fs::perms::owner_all);
  }
  Script(const Script&) = delete;
  Script& operator=(const Script&) = delete;
  ~Script() { fs::remove(file_); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_;
  fs::path file_;
};

}  // namespace

TEST_CASE("child process: how it ended is told in words and as a number", "[run]") {
  const Script script{"test $1 = kill && kill -9 $$; exit $1"};
  ChildProcess done{script.name(), {"3"}};
  REQUIRE(eventually([&] { return done.ended().has_value(); }));
  CHECK(*done.ended() == "exit status 3");
  CHECK(done.exit_status() == 3);
  ChildProcess killed{script.name(), {"kill"}};
  REQUIRE(eventually([&] { return killed.ended().has_value(); }));
  CHECK(*killed.ended() == "signal 9");
  CHECK_FALSE(killed.exit_status().has_value());
}

TEST_CASE("child process: its standard input lasts as long as its parent", "[run]") {
  const Script script{"cat; exit 5"};
  ChildProcess child{script.name(), {}};
  std::this_thread::sleep_for(milliseconds{50});
  CHECK_FALSE(child.ended().has_value());
  CHECK(fs::read_symlink("/proc/" + std::to_string(child.pid()) + "/fd/0").string().find("pipe:") ==
        0);
}

TEST_CASE("child process: one that somebody else has waited for has ended", "[run]") {
  const Script script{"exit 0"};
  ChildProcess child{script.name(), {}};
  REQUIRE(waitpid(child.pid(), nullptr, 0) == child.pid());
  REQUIRE(child.ended().has_value());
  CHECK(*child.ended() == "unseen");
}

TEST_CASE("child process: it starts with no signal blocked or ignored", "[run]") {
  sigset_t set;
  sigset_t before;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  REQUIRE(pthread_sigmask(SIG_BLOCK, &set, &before) == 0);
  const auto ignored = std::signal(SIGHUP, SIG_IGN);
  const Script script{
      "grep -q 'SigBlk:.*0000000000000000' /proc/self/status &&"
      " grep -q 'SigIgn:.*0000000000000000' /proc/self/status"};
  ChildProcess child{script.name(), {}};
  CHECK(eventually([&] { return child.ended().has_value(); }));
  CHECK(child.exit_status() == 0);
  std::signal(SIGHUP, ignored);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST_CASE("child process: one that does not heed its stop is killed", "[run]") {
  const Script script{"trap '' TERM; echo >&2; while :; do sleep 0.05; done"};
  ChildProcess child{script.name(), {}};
  std::this_thread::sleep_for(milliseconds{200});
  child.stop(milliseconds{50});
  CHECK(child.ended().has_value());
  CHECK(kill(child.pid(), 0) != 0);
}

TEST_CASE("child process: a program that is not there is refused", "[run]") {
  CHECK_THROWS_AS((ChildProcess{"no-such-program", {}}), StartupError);
}
