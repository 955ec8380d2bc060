// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/diagnosis.h"

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using namespace cli;

constexpr std::uint64_t kMiB = 1U << 20U;

[[nodiscard]] MachineFacts healthy() {
  MachineFacts facts;
  facts.fifo_allowed = true;
  facts.fifo_priority = 70;
  facts.lock_limit_bytes = 200 * kMiB;
  facts.lock_needed_bytes = 100 * kMiB;
  facts.shm_writable = true;
  facts.shm_free_bytes = 64 * kMiB;
  facts.segment_bytes = 4 * kMiB;
  facts.gnuplot = true;
  facts.configuration = "/opt/lodesman";
  facts.program_directory = "/opt/lodesman/bin";
  facts.governor = "powersave";
  return facts;
}

[[nodiscard]] Finding finding(const MachineFacts& facts, const std::string& name) {
  for (const Finding& one : judge(facts)) {
    if (one.name == name) {
      return one;
    }
  }
  FAIL("no finding " + name);
  return {};
}

TEST_CASE("doctor: nothing is wrong with a healthy machine", "[cli]") {
  const auto findings = judge(healthy());
  REQUIRE_FALSE(any_bad(findings));
  for (const Finding& one : findings) {
    CAPTURE(one.line());
    REQUIRE((one.verdict == Verdict::kOk || one.verdict == Verdict::kInfo));
  }
}

TEST_CASE("doctor: what killed boats have left is named with the command that removes it",
          "[cli]") {
  MachineFacts facts = healthy();
  CHECK(finding(facts, "leftovers").verdict == Verdict::kOk);
  facts.dead_segments = {"lodesman-sim-7", "lodesman-boat"};
  CHECK_FALSE(any_bad(judge(facts)));
  CHECK(finding(facts, "leftovers").verdict == Verdict::kWarn);
  CHECK(finding(facts, "leftovers").what ==
        "killed boats have left 2 segments of 4 MiB in /dev/shm");
  CHECK(finding(facts, "leftovers").remedy == "rm /dev/shm/lodesman-sim-7 /dev/shm/lodesman-boat");
}

TEST_CASE("doctor: what only makes a run worse is a warning", "[cli]") {
  MachineFacts facts = healthy();
  facts.fifo_allowed = false;
  facts.lock_limit_bytes = 8 * kMiB;
  facts.gnuplot = false;
  REQUIRE_FALSE(any_bad(judge(facts)));
  REQUIRE(finding(facts, "sched_fifo").verdict == Verdict::kWarn);
  REQUIRE(finding(facts, "sched_fifo").remedy.find("rtprio 70") != std::string::npos);
  REQUIRE(finding(facts, "memory_lock").line().starts_with("warn  memory_lock    8 MiB may be"));
  REQUIRE(finding(facts, "gnuplot").remedy == "sudo apt-get install gnuplot-nox");
  facts.root = true;
  REQUIRE(finding(facts, "sched_fifo").remedy == "start the container with --cap-add SYS_NICE");
  facts.lock_unlimited = true;
  REQUIRE(finding(facts, "memory_lock").verdict == Verdict::kOk);
}

TEST_CASE("doctor: what rt-test could make use of is named and wrong with nothing", "[cli]") {
  MachineFacts facts = healthy();
  CHECK(finding(facts, "rt_test").remedy.empty());
  facts.rt_test_missing = {"stress-ng", "rt-tests"};
  CHECK(finding(facts, "rt_test").verdict == Verdict::kInfo);
  CHECK(finding(facts, "rt_test").remedy == "sudo apt-get install stress-ng rt-tests");
}

TEST_CASE("doctor: what keeps the boat ashore is bad", "[cli]") {
  MachineFacts no_shm = healthy();
  no_shm.shm_writable = false;
  REQUIRE(any_bad(judge(no_shm)));
  MachineFacts small_shm = healthy();
  small_shm.shm_free_bytes = kMiB;
  REQUIRE(finding(small_shm, "shared_memory").verdict == Verdict::kBad);
  MachineFacts wrong_file = healthy();
  wrong_file.configuration_error = "default.toml:3: a: unknown key";
  REQUIRE(finding(wrong_file, "configuration").what == "default.toml:3: a: unknown key");
  REQUIRE(any_bad(judge(wrong_file)));
  MachineFacts no_low = healthy();
  no_low.programs_missing = {"lodesman-low"};
  REQUIRE(finding(no_low, "programs").remedy ==
          "cmake --build /opt/lodesman --target lodesman-low");
  REQUIRE(finding(no_low, "programs").to_json().at("verdict") == "bad");
}

TEST_CASE("doctor: this machine can be measured", "[cli]") {
  const MachineFacts facts = measure_machine({});
  REQUIRE(facts.fifo_priority > 0);
  REQUIRE(facts.segment_bytes > kMiB);
  REQUIRE(facts.lock_needed_bytes > facts.segment_bytes);
  REQUIRE(facts.configuration_error.empty());
  REQUIRE(judge(facts).size() == 10);
}

}  // namespace
}  // namespace lodesman::testing
