// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/gpsd.h"

#include "tests/support/catch.h"

namespace lodesman::testing {
namespace {

using namespace cli;

[[nodiscard]] GpsdFacts answering() {
  GpsdFacts facts;
  facts.place = "localhost:2947";
  for (const char* line :
       {R"({"class":"VERSION","release":"3.22","rev":"3.22","proto_major":3,"proto_minor":14})",
        R"({"class":"DEVICES","devices":[{"class":"DEVICE","path":"/dev/ttyACM0"}]})"}) {
    take_gpsd_line(line, facts);
  }
  return facts;
}

TEST_CASE("doctor: a gpsd with a receiver is well, and said with its version", "[cli]") {
  const Finding finding = judge_gpsd(answering());
  CHECK(finding.verdict == Verdict::kOk);
  CHECK(finding.what == "gpsd 3.22 at localhost:2947 has /dev/ttyACM0");
}

TEST_CASE("doctor: a gpsd that is not there, is another, or has no receiver, is bad", "[cli]") {
  CHECK(judge_gpsd({}).verdict == Verdict::kBad);
  GpsdFacts facts = answering();
  facts.receivers.clear();
  CHECK(judge_gpsd(facts).verdict == Verdict::kBad);
  facts = answering();
  facts.protocol_major = 4;
  CHECK(judge_gpsd(facts).verdict == Verdict::kBad);
  facts = answering();
  facts.wanted = "/dev/ttyACM1";
  CHECK(judge_gpsd(facts).verdict == Verdict::kBad);
  facts.receivers.emplace_back("/dev/ttyACM1");
  CHECK(judge_gpsd(facts).verdict == Verdict::kOk);
  facts.wanted.clear();
  CHECK(judge_gpsd(facts).verdict == Verdict::kWarn);
}

TEST_CASE("doctor: what is no answer of a gpsd is passed over", "[cli]") {
  GpsdFacts facts;
  for (const char* line : {"", "SSH-2.0-OpenSSH", "[1]", "{\"class\":3}",
                           R"({"class":"DEVICES","devices":[1,"x"]})", "{\"class\":\"VERSION\""}) {
    take_gpsd_line(line, facts);
  }
  CHECK(!facts.answers);
  CHECK(facts.receivers.empty());
}

TEST_CASE("doctor: only a gpsd's address is asked, and nobody at a port where none listens",
          "[cli]") {
  CHECK(!measure_gpsd("nmea:/dev/ttyUSB2"));
  CHECK(!measure_gpsd("none"));
  CHECK(!measure_gpsd("gpsd:localhost:0"));
  const auto facts = measure_gpsd("gpsd:[x]?device=/dev/ttyACM0");
  REQUIRE(facts);
  CHECK(facts->wanted == "/dev/ttyACM0");
  CHECK(!facts->answers);
}

}  // namespace
}  // namespace lodesman::testing
