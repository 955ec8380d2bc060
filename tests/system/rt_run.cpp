// SPDX-License-Identifier: Apache-2.0
// `lodesman rt-test` as a user starts it. What it finds is the machine's affair; that it looks,
// that its report is whole, and that nothing is left, is ours.
#include <nlohmann/json.hpp>
#include <numeric>

#include "deploy/operator/rt_test/allocation_counter.h"
#include "deploy/operator/rt_test/companion.h"
#include "tests/system/program.h"
#include "tests/system/program_bench.h"

namespace lodesman::testing {
namespace {

using nlohmann::json;

std::uint64_t sum(const json& histogram) {
  return std::accumulate(
      histogram.begin(), histogram.end(), std::uint64_t{0},
      [](std::uint64_t all, const json& count) { return all + count.get<std::uint64_t>(); });
}

// Where the command makes its files, so that what it leaves can be seen.
class OwnTemporary {
 public:
  OwnTemporary() { REQUIRE(setenv("TMPDIR", scratch_.file("").c_str(), 1) == 0); }
  OwnTemporary(const OwnTemporary&) = delete;
  OwnTemporary& operator=(const OwnTemporary&) = delete;
  ~OwnTemporary() { unsetenv("TMPDIR"); }
  [[nodiscard]] bool is_empty() const { return fs::is_empty(scratch_.file("")); }

 private:
  Scratch scratch_{"rt-test"};
};

bool alive(pid_t process) { return process > 0 && kill(process, 0) == 0; }

// The command's children, and theirs.
std::vector<pid_t> offspring_of(pid_t process) {
  const std::string id = std::to_string(process);
  std::vector<pid_t> all;
  std::ifstream children{"/proc/" + id + "/task/" + id + "/children"};
  for (pid_t child = 0; children >> child;) {
    all.push_back(child);
    const auto grandchildren = offspring_of(child);
    all.insert(all.end(), grandchildren.begin(), grandchildren.end());
  }
  return all;
}

std::vector<std::string> rt_test_words() {
  std::vector<std::string> words{"rt-test", "--seconds", "60", "--quiet"};
  if (!find_program("stress-ng").empty()) {
    words.insert(words.end(), {"--load", "cpu"});
  }
  return words;
}

// Ended by that signal while the boat sails: its offspring is gone soon after.
void check_clean_end(int signal) {
  Program command{program("lodesman"), rt_test_words()};
  { const SharedBlackboard board = under_way(command); }
  const auto offspring = offspring_of(command.pid());
  CHECK(offspring.size() >= 2);
  REQUIRE(kill(command.pid(), signal) == 0);
  CHECK(command.status() == (signal == SIGKILL ? 128 + SIGKILL : 1));
  for (const pid_t process : offspring) {
    INFO(process);
    CHECK(eventually([&] { return !alive(process); }));
  }
  if (signal != SIGKILL) {
    CHECK_FALSE(any_segment_of(command.pid()));
  }
  remove_dead_segment("lodesman-sim-" + std::to_string(command.pid()));
}

}  // namespace

TEST_CASE("rt-test: its report is whole and agrees with itself", "[system]") {
  const Bench bench;  // its own files are none of the command's
  const OwnTemporary temporary;
  const Outcome outcome = bench.run(program("lodesman"), {"rt-test", "--seconds", "6", "--json"});
  INFO(outcome.error);
  CHECK((outcome.status == 0 || outcome.status == 1));
  const json report = json::parse(outcome.out);
  CHECK(report["verdict"] == (outcome.status == 0 ? "pass" : "fail"));
  CHECK(report["reasons"].empty() == (outcome.status == 0));
  CHECK(report["seconds"].get<double>() >= 6.0);
  CHECK(report["cyclictest"].is_null());
  REQUIRE(report["tasks"].size() == kTaskCount);
  for (const json& task : report["tasks"]) {
    INFO(task.dump());
    const auto steps = task["steps"].get<std::uint64_t>();
    CHECK(steps > 10);
    CHECK(sum(task["took"]["histogram"]) == steps);
    CHECK(sum(task["wake_late"]["histogram"]) == task["wakes"].get<std::uint64_t>());
    CHECK(sum(task["late"]["histogram"]) + sum(task["wake_late"]["histogram"]) == steps);
    CHECK(task["took"]["p50_us"] <= task["took"]["p99_us"]);
    CHECK(task["took"]["p99_us"] <= task["took"]["worst_us"]);
    CHECK(task["minor_faults"].is_number());
    if (!allocations_library().empty()) {
      CHECK(task["allocations"] == 0);
    }
  }
  CHECK(temporary.is_empty());
}

TEST_CASE("rt-test: beside cyclictest, where that is installed and may run", "[system]") {
  if (find_program("cyclictest").empty()) {
    const Outcome outcome =
        Bench{}.run(program("lodesman"), {"rt-test", "--cyclictest", "--seconds", "5"});
    CHECK(outcome.status == 2);
    CHECK(outcome.error ==
          "--cyclictest: cyclictest is not installed: sudo apt-get install rt-tests\n");
    return;
  }
  const Outcome outcome =
      Bench{}.run(program("lodesman"), {"rt-test", "--cyclictest", "--seconds", "5", "--json"});
  INFO(outcome.error);
  CHECK((outcome.status == 0 || outcome.status == 1));
  const json report = json::parse(outcome.out);
  if (report["cyclictest"].is_null()) {
    CHECK(!report["cyclictest_why"].get<std::string>().empty());
  } else {
    const json& figures = report["cyclictest"];
    CHECK(figures["wakes"].get<std::uint64_t>() > 100);
    CHECK(sum(figures["histogram"]) == figures["wakes"].get<std::uint64_t>());
    CHECK(figures["worst_us"] >= figures["p99_us"]);
  }
}

TEST_CASE("rt-test: a signal ends all of it and leaves nothing", "[system]") {
  const OwnTemporary temporary;
  check_clean_end(SIGTERM);
  check_clean_end(SIGINT);
  check_clean_end(SIGHUP);
  CHECK(temporary.is_empty());
}

TEST_CASE("rt-test: killed, it takes what it started with it", "[system]") {
  const OwnTemporary temporary;
  check_clean_end(SIGKILL);
}

TEST_CASE("rt-test: what it cannot do is refused before anything is started", "[system]") {
  const Bench bench;  // its own files are none of the command's
  const OwnTemporary temporary;
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"rt-test", "--seconds", "1"},
        {"rt-test", "--seconds", "4000"},
        {"rt-test", "--load", "much"},
        {"rt-test", "--set", "devices.heading=\"nav440:/dev/null\""}}) {
    CAPTURE(words);
    const Outcome outcome = bench.run(program("lodesman"), words);
    CHECK(outcome.status == 2);
    CHECK(outcome.out.empty());
    CHECK(std::count(outcome.error.begin(), outcome.error.end(), '\n') == 1);
  }
  CHECK(temporary.is_empty());
}

}  // namespace lodesman::testing
