// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/thread_facts.h"

#include <unistd.h>

#include "tests/support/catch.h"

namespace lodesman::cli {

TEST_CASE("thread facts: a line of the kernel's, whatever the thread is called",
          "[operator][rt_test]") {
  const auto thread = read_thread_stat(
      "4711 (a name) of (b) S 1 2 3 4 5 6 17 99 18 98 30 12 0 0 20 0 1 0 100 4096 5");
  REQUIRE(thread);
  CHECK(thread->name == "a name) of (b");
  CHECK(thread->facts.thread == 4711);
  CHECK(thread->facts.minor_faults == 17);
  CHECK(thread->facts.major_faults == 18);
  CHECK(thread->facts.cpu_ticks == 42);
}

TEST_CASE("thread facts: what is no such line is none", "[operator][rt_test]") {
  for (const char* line : {"", "4711", "4711 (thruster)", "4711 (thruster) S 1 2 3", ")(",
                           "x (y) S", "4711 (thruster) S 1 2 3 4 5 6 a 99 18 98 30 12"}) {
    INFO(line);
    CHECK_FALSE(read_thread_stat(line));
  }
}

TEST_CASE("thread facts: how often it was put off", "[operator][rt_test]") {
  CHECK(read_put_off("Name:\tx\nvoluntary_ctxt_switches:\t7\nnonvoluntary_ctxt_switches:\t12\n") ==
        12);
  CHECK(read_put_off("Name:\tx\n") == 0);
}

TEST_CASE("thread facts: this program's own main thread is found", "[operator][rt_test]") {
  bool found = false;
  for (const auto& [name, facts] : thread_facts(getpid())) {
    found = found || (facts.thread == getpid() && facts.minor_faults > 0);
  }
  CHECK(found);
  CHECK(thread_facts(0).empty());
}

}  // namespace lodesman::cli
