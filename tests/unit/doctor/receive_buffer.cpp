// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/receive_buffer.h"

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using namespace cli;

TEST_CASE("doctor: too small a buffer for a sonar's datagrams is a warning with what mends it",
          "[cli]") {
  const Finding small = judge_receive_buffer({1U << 20U, 212992});
  CHECK(small.verdict == Verdict::kWarn);
  CHECK(small.what ==
        "208 KiB of a sonar's datagrams may wait here, 1024 KiB are asked for: on a busy machine "
        "pings are lost");
  CHECK(small.remedy.find("net.core.rmem_max=1048576") != std::string::npos);
  CHECK(judge_receive_buffer({1U << 20U, 1U << 20U}).verdict == Verdict::kOk);
  CHECK(judge_receive_buffer({1U << 20U, 1U << 20U}).remedy.empty());
}

TEST_CASE("doctor: a buffer is tried for a sonar that sends datagrams, and for no other", "[cli]") {
  const auto facts = measure_receive_buffer("delta_t:192.168.0.2");
  REQUIRE(facts);
  CHECK(facts->wanted_bytes == 1U << 20U);
  CHECK(facts->granted_bytes >= 1024);
  CHECK(facts->granted_bytes <= facts->wanted_bytes);
  for (const char* other : {"sim:sonar", "loop:delta_t", "file:pings", ""}) {
    CHECK_FALSE(measure_receive_buffer(other));
  }
}

}  // namespace
}  // namespace lodesman::testing
