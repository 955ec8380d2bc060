// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/commander.h"

#include "tests/support/catch.h"

using namespace lodesman;

namespace {
Time at(double seconds) { return Time{from_seconds(100.0 + seconds)}; }
}  // namespace

TEST_CASE("commander: while nobody commands anybody may order", "[high_level][mission]") {
  const Commander commander;
  CHECK_FALSE(commander.objection(1, at(0)));
  CHECK(commander.link().session == 0);
}

TEST_CASE("commander: one at a time, until its heartbeat is lost", "[high_level][mission]") {
  Commander commander;
  CHECK_FALSE(commander.take(1, "bridge", false, at(0)));
  CHECK_FALSE(commander.objection(1, at(1)));
  CHECK(commander.objection(2, at(1)).value().find("held by \"bridge\"") != std::string::npos);
  CHECK(commander.take(2, "shore", false, at(1)));
  CHECK_FALSE(commander.beat(1, at(2)));
  CHECK(commander.beat(2, at(2)));
  CHECK(commander.link().heard == at(2));
  CHECK(commander.objection(2, at(2) + kCommanderPatience));
  CHECK_FALSE(commander.objection(2, at(2) + kCommanderPatience + Duration{1}));
}

TEST_CASE("commander: command changes hands by release, or by force", "[high_level][mission]") {
  Commander commander;
  CHECK_FALSE(commander.take(1, "bridge", false, at(0)));
  CHECK(commander.release(2));
  CHECK_FALSE(commander.release(1));
  CHECK(commander.link().session == 0);
  CHECK_FALSE(commander.take(2, "shore", false, at(1)));
  CHECK_FALSE(commander.take(3, "chief", true, at(2)));
  CHECK(commander.link().session == 3);
  CHECK(commander.link().opened == at(2));
  CHECK(commander.beat(2, at(3)).value().find("chief") != std::string::npos);
}

TEST_CASE("commander: a session that ends without a release has lost its link, not closed it",
          "[high_level][mission]") {
  Commander commander;
  CHECK_FALSE(commander.take(1, "bridge", false, at(0)));
  commander.ended(1);
  CHECK_FALSE(commander.commands(at(0.5)));
  CHECK_FALSE(commander.objection(2, at(0.5)));
  CHECK(commander.link().session == 1);  // the mission may act on it
  commander.forget_the_lost(at(0.5));    // the next start is not its mission
  CHECK(commander.link().session == 0);
}
