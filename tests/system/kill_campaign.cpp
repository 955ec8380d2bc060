// SPDX-License-Identifier: Apache-2.0
// Fifty kills of each program at random times while under way, as a table. Not part of a usual
// run, which kills each a few times (processes.cpp): test_kill_campaign "[.campaign]".
#include <algorithm>
#include <iostream>

#include "tests/system/boat.h"

using namespace lodesman;
using namespace lodesman::testing;

namespace {

constexpr int kKills = 50;

std::mt19937 seeded(const char* what) {
  const auto seed = static_cast<unsigned>(SteadyClock{}.now().time_since_epoch().count());
  std::cout << what << ": seed " << seed << "\n";
  return std::mt19937{seed};
}

class Table {
 public:
  void add(const std::string& what, double seconds) {
    for (auto& row : rows_) {
      if (row.what == what) {
        row.seconds.push_back(seconds);
        return;
      }
    }
    rows_.push_back({what, {seconds}});
  }
  void print() {
    for (auto& row : rows_) {
      std::sort(row.seconds.begin(), row.seconds.end());
      std::cout << "  " << row.what << ", of " << row.seconds.size() << ": median "
                << row.seconds[row.seconds.size() / 2] << " s, worst " << row.seconds.back()
                << " s\n";
    }
  }
  [[nodiscard]] double worst(std::size_t row) const {
    return *std::max_element(rows_[row].seconds.begin(), rows_[row].seconds.end());
  }

 private:
  struct Row {
    std::string what;
    std::vector<double> seconds;
  };
  std::vector<Row> rows_;
};

// A launched run that is under way.
struct Run {
  explicit Run(const Scratch& scratch)
      : launcher{"lodesman",
                 {"sim", scratch.file("far.toml", scenario_text(25.0)).string(), "--profile",
                  "paper", "--out", scratch.file("run").string(), "--quiet", "--no-images", "--set",
                  "command_socket.port=0"}},
        board{SharedBlackboard::observe("lodesman-sim-" + std::to_string(launcher.pid()),
                                        kPatience)} {
    Reader<ThrustApplied> thrust{board->thrust_applied};
    REQUIRE(eventually([&] { return drives(thrust.latest()); }));
  }
  ChildProcess launcher;
  SharedBlackboard board;
};

void wait_a_random_while(std::mt19937& random) {
  std::this_thread::sleep_for(milliseconds{random() % 1000});
}

}  // namespace

TEST_CASE("kill campaign: the high level", "[.campaign]") {
  const Scratch scratch{"campaign-high"};
  Boat boat{scratch};
  auto random = seeded("lodesman-high killed");
  Table table;
  for (int i = 0; i < kKills; ++i) {
    table.add("neutral after its last command", neutral_after_kill_s(boat, random));
    boat.start_high();  // finds the segment and drives again, or the next turn fails
  }
  table.print();
  CHECK(table.worst(0) <= 0.5);
}

TEST_CASE("kill campaign: the low level", "[.campaign]") {
  auto random = seeded("lodesman-low killed");
  Table table;
  const SteadyClock clock;
  for (int i = 0; i < kKills; ++i) {
    const Scratch scratch{"campaign-low"};
    Run run{scratch};
    wait_a_random_while(random);
    const pid_t low = child_of(run.launcher.pid(), "lodesman-low");
    REQUIRE(low > 0);
    const Time killed = clock.now();
    REQUIRE(kill(low, SIGKILL) == 0);
    REQUIRE(eventually([&] { return run.launcher.ended().has_value(); }));
    table.add("the launcher ends", to_seconds(clock.now() - killed));
    CHECK(*run.launcher.ended() == "exit status 4");
    Reader<HelmCommand> helm{run.board->helm_command};
    CHECK(await_first(helm).value.surge_ref == 0);  // its last word was a neutral one
    table.add("the high level's last command", to_seconds(await_first(helm).stamp - killed));
    CHECK_FALSE(run.board.alive(Role::kHigh));
    CHECK_FALSE(any_segment_of(run.launcher.pid()));
  }
  table.print();
}

TEST_CASE("kill campaign: the launcher", "[.campaign]") {
  auto random = seeded("the launcher killed");
  Table table;
  const SteadyClock clock;
  for (int i = 0; i < kKills; ++i) {
    const Scratch scratch{"campaign-launcher"};
    Run run{scratch};
    wait_a_random_while(random);
    const Time killed = clock.now();
    REQUIRE(kill(run.launcher.pid(), SIGKILL) == 0);
    REQUIRE(
        eventually([&] { return !run.board.alive(Role::kLow) && !run.board.alive(Role::kHigh); }));
    table.add("both processes are gone", to_seconds(clock.now() - killed));
    REQUIRE(eventually([&] { return !any_segment_of(run.launcher.pid()); }));
  }
  table.print();
}
