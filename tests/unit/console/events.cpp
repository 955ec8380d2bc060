// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/events.h"

#include "tests/support/catch.h"
#include "tests/unit/console/small_board.h"

using namespace lodesman;
using namespace lodesman::console;
using namespace lodesman::testing;

TEST_CASE("console events: an order, who gave it and what became of it", "[console]") {
  const auto event = event_of({"Ann",
                               "tune",
                               Json::parse(R"({"set":{"zones.margin_m":1.5}})"),
                               {true, R"({"ok":true,"tunables":{}})"}});
  REQUIRE(event);
  CHECK(event->text == "tune zones.margin_m = 1.5: done");
  CHECK(event->who == "Ann");
  const auto refused = event_of(
      {"Ann", "start", Json::object(), {true, R"({"ok":false,"error":"not ready: no heading"})"}});
  REQUIRE(refused);
  CHECK(refused->text == "start: refused: not ready: no heading");
  CHECK(refused->severity == Severity::kWarning);
  CHECK_FALSE(event_of({"Ann", "heartbeat", Json::object(), {true, "{}"}}));
  CHECK_FALSE(event_of({"Ann", "status", Json::object(), {true, "{}"}}));
}

TEST_CASE("console events: a change of state is told once", "[console]") {
  SmallBoard boat;
  ChangeWatch watch;
  CHECK(watch.look(boat.look(), true).size() == 1);  // there is a boat
  CHECK(watch.look(boat.look(), true).empty());
  boat.publish_mission(MissionState::kAborted, MissionCause::kDisarmed);
  const auto events = watch.look(boat.look(), true);
  REQUIRE(events.size() == 1);
  CHECK(events[0].text == "mission: aborted (disarmed)");
  CHECK(events[0].severity == Severity::kWarning);
  CHECK(watch.look({}, false).size() == 1);
  CHECK(watch.look({}, false).empty());
}
