// SPDX-License-Identifier: Apache-2.0
// What gpsd and the receiver behind it do wrong (docs/device_faults.md), and what they do right.
#include <chrono>

#include "tests/support/allocations.h"
#include "tests/unit/gpsd/support.h"

namespace lodesman::testing {
namespace {

TEST_CASE("gpsd: it is asked to report with each connection, and a fix is what it reports",
          "[gpsd]") {
  Wired wired;
  wired.say(kGreeting);
  CHECK(wired.fixes().empty());
  CHECK(wired.heard() == "?WATCH={\"enable\":true,\"json\":true};\n");
  wired.say(R"({"class":"SKY","device":"/dev/pts/3","hdop":0.9,"uSat":8})"
            "\r\n");
  const auto fixes = wired.fixes_of({});
  REQUIRE(fixes.size() == 1);
  const PositionFix& fix = fixes.front();
  CHECK(fix.latitude_deg == Approx(35.0272));
  CHECK(fix.longitude_deg == Approx(138.9));
  CHECK(fix.measured == wired.now - seconds{1});
  CHECK(fix.source == FixSource::kGpsd);
  CHECK(fix.sigma_m == Approx(2.7));
  CHECK(fix.utc_ns == 1795264500'000'000'000);
  CHECK(fix.has_speed);
  CHECK(fix.speed_m_s == Approx(0.5));
  CHECK(fix.has_course);
  wired.line_->unplug();
  CHECK(wired.fixes().empty());
  wired.line_->plug();
  CHECK(wired.fixes().empty());
  CHECK(wired.heard() == "?WATCH={\"enable\":true,\"json\":true};\n");
}

TEST_CASE("gpsd: G1: a silent receiver is told of after 3 s, and why as far as gpsd knows",
          "[gpsd]") {
  Wired wired;
  wired.say(std::string{kGreeting} + kOneDevice);
  REQUIRE(wired.fixes_of({}).size() == 1);
  static_cast<void>(wired.heard());
  wired.pass(milliseconds{1900});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNone);
  wired.pass(milliseconds{200});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoAnswer);
  CHECK(wired.heard() == "?DEVICES;\n");
  wired.say(kOneDevice);
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoAnswer);
  // It lives: the connection is kept, however long the receiver says nothing.
  for (int i = 0; i < 60; ++i) {
    wired.pass(seconds{1});
    CHECK(wired.fixes().empty());
    if (!wired.heard().empty()) {
      wired.say(kOneDevice);
    }
  }
  CHECK(wired.driver.counts().given_up == 0);
  Told told;
  told.second = 60;
  told.latitude_deg += 0.0003;
  CHECK(wired.fixes_of(told).size() == 1);
}

TEST_CASE("gpsd: G1: a receiver that was unplugged is said to be so", "[gpsd]") {
  Wired wired;
  wired.say(std::string{kGreeting} + kOneDevice);
  REQUIRE(wired.fixes_of({}).size() == 1);
  wired.say("{\"class\":\"DEVICE\",\"path\":\"/dev/pts/3\",\"activated\":0}\r\n");
  wired.pass(seconds{3});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kUnplugged);
  wired.say(kNoDevice);
  wired.pass(milliseconds{100});
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoPort);
}

TEST_CASE("gpsd: G2: after gpsd was gone a fix is used only if its time is newer", "[gpsd]") {
  Wired wired;
  Told told;
  REQUIRE(wired.fixes_of(told).size() == 1);
  wired.line_->unplug();
  for (int i = 0; i < 5; ++i) {
    CHECK(wired.fixes().empty());
    CHECK(wired.last == ReadStatus::kDisconnected);
    wired.pass(seconds{1});
  }
  wired.line_->plug();
  CHECK(wired.fixes_of(told).empty());  // the old one, as a restarted gpsd may give it
  told.second = 7;
  CHECK(wired.fixes_of(told).size() == 1);
}

TEST_CASE("gpsd: G3: a report without a time is no fix, and is counted", "[gpsd]") {
  Wired wired;
  wired.say("{\"class\":\"TPV\",\"mode\":3,\"lat\":35.0272,\"lon\":138.9,\"eph\":17.1}\r\n");
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.counts().without_time == 1);
  CHECK(wired.fixes_of({}).empty() == false);
}

TEST_CASE("gpsd: G4: two reports of one time are one fix", "[gpsd]") {
  Wired wired;
  wired.say(tpv_line({}) + tpv_line({}));
  CHECK(wired.fixes().size() == 1);
  CHECK(wired.driver.counts().repeated == 1);
}

TEST_CASE("gpsd: G5: a fix that is lost is none", "[gpsd]") {
  Wired wired;
  REQUIRE(wired.fixes_of({}).size() == 1);
  wired.say("{\"class\":\"TPV\",\"device\":\"/dev/pts/3\",\"mode\":1}\r\n");
  CHECK(wired.fixes().empty());
  CHECK(wired.driver.fault() == DeviceFault::kNoFix);
  // The old place with mode 1, and mode 3 of what is reckoned, simulated or time alone.
  Told told;
  told.second = 2;
  told.mode = 1;
  CHECK(wired.fixes_of(told).empty());
  told.mode = 3;
  for (const int status : {5, 7, 8}) {
    told.status = status;
    ++told.second;
    CHECK(wired.fixes_of(told).empty());
  }
  CHECK(wired.driver.counts().voids == 5);
}

TEST_CASE("gpsd: G6: an accuracy that is not known is that of the table", "[gpsd]") {
  Wired wired;
  wired.say(
      "{\"class\":\"TPV\",\"mode\":2,\"time\":\"2026-11-21T12:35:00.000Z\",\"lat\":35.0,"
      "\"lon\":138.9}\r\n");
  const auto fixes = wired.fixes();
  REQUIRE(fixes.size() == 1);
  CHECK(fixes.front().quality == FixQuality::kUnknown);
  CHECK(fixes.front().sigma_m == Approx(6.0));
}

TEST_CASE("gpsd: G7: accuracy is by the fix's status, whatever eph says", "[gpsd]") {
  struct Row {
    int status;
    FixQuality quality;
    double sigma_m;
  };
  Wired wired;
  wired.say("{\"class\":\"SKY\",\"hdop\":0.8}\r\n");
  Told told;
  for (const Row& row : {Row{1, FixQuality::kSingle, 2.4}, Row{2, FixQuality::kDifferential, 0.8},
                         Row{3, FixQuality::kRtkFixed, 0.02}, Row{4, FixQuality::kRtkFloat, 0.32},
                         Row{6, FixQuality::kSingle, 2.4}}) {
    told.status = row.status;
    ++told.second;
    const auto fixes = wired.fixes_of(told);
    INFO(row.status);
    REQUIRE(fixes.size() == 1);
    CHECK(fixes.front().quality == row.quality);
    CHECK(fixes.front().sigma_m == Approx(row.sigma_m));
  }
}

TEST_CASE("gpsd: G8: latitude and longitude 0 are no place, in mode 3 too", "[gpsd]") {
  Wired wired;
  Told told;
  told.latitude_deg = told.longitude_deg = 0.0;
  CHECK(wired.fixes_of(told).empty());
  CHECK(wired.corrupt == 1);
  CHECK(wired.driver.fault() == DeviceFault::kImplausible);
}

TEST_CASE("gpsd: G9: a line that comes in pieces is one fix, half a line is none", "[gpsd]") {
  for (std::size_t piece = 1; piece <= 7; ++piece) {
    Wired wired;
    const std::string line = tpv_line({});
    std::size_t given = 0;
    for (std::size_t at = 0; at < line.size(); at += piece) {
      CHECK(given == 0);
      wired.say(std::string_view{line}.substr(at, piece));
      given += wired.fixes().size();
      wired.pass(milliseconds{1});
    }
    CHECK(given == 1);
    CHECK(wired.corrupt == 0);
  }
}

TEST_CASE("gpsd: G10: a date 1024 weeks back changes no stamp and is given to nobody", "[gpsd]") {
  Wired wired;
  Told told;
  for (int i = 0; i < 6; ++i) {
    told.second = i;
    told.date = i < 3 ? "2026-11-21" : "2007-04-07";
    const auto fixes = wired.fixes_of(told);
    REQUIRE(fixes.size() == 1);
    CHECK(fixes.front().measured == wired.now - seconds{1});
    CHECK((fixes.front().utc_ns == 0) == (i >= 3));
  }
  CHECK(wired.driver.fault() == DeviceFault::kWrongDate);
}

TEST_CASE("gpsd: G14: a gpsd that is silent though connected is given up and looked for anew",
          "[gpsd]") {
  Wired wired;
  wired.say(kGreeting);
  Told told;
  REQUIRE(wired.fixes_of(told).size() == 1);
  const Time heard = wired.now - seconds{1};
  while (wired.driver.fault() != DeviceFault::kNoAnswer) {
    wired.pass(milliseconds{100});
    CHECK(wired.fixes().empty());
  }
  CHECK(wired.now - heard <= milliseconds{3200});
  while (wired.driver.counts().given_up == 0) {
    REQUIRE(wired.now - heard < seconds{10});
    wired.pass(milliseconds{100});
    CHECK(wired.fixes().empty());
  }
  CHECK(wired.fixes().empty());
  CHECK(wired.heard().ends_with("?WATCH={\"enable\":true,\"json\":true};\n"));
  told.second = 20;
  CHECK(wired.fixes_of(told).size() == 1);
}

TEST_CASE("gpsd: of two receivers one is listened to until it is silent", "[gpsd]") {
  Wired wired;
  Told told;
  Told other;
  other.device = "/dev/ttyACM1";
  other.latitude_deg += 0.001;
  for (int i = 0; i < 5; ++i) {
    told.second = other.second = i;
    wired.say(tpv_line(told));
    CHECK(wired.fixes().size() == 1);
    CHECK(wired.fixes_of(other).empty());
  }
  CHECK(wired.driver.counts().of_others == 5);
  for (int i = 5; i < 12; ++i) {
    other.second = i;
    CHECK(wired.fixes_of(other).size() == (i < 8 ? 0U : 1U));
  }
  Wired chosen{"/dev/ttyACM1"};
  CHECK(chosen.fixes_of(told).empty());
  CHECK(chosen.fixes_of(other).size() == 1);
}

TEST_CASE("gpsd: C3: a position that repeats itself under way is frozen after 10 s", "[gpsd]") {
  Wired wired;
  Told told;
  int given = 0;
  for (int i = 0; i < 20; ++i) {
    told.second = i;
    given += static_cast<int>(wired.fixes_of(told).size());
  }
  CHECK(given == 10);
  CHECK(wired.driver.fault() == DeviceFault::kFrozen);
}

TEST_CASE("gpsd: lines that are no reports, or have no end, are counted and cost no fix",
          "[gpsd]") {
  Wired wired;
  wired.say("nonsense\r\n{\"class\":\"TPV\",\"mode\":3\r\n" +
            std::string(GpsdReceiver::kLongestLine + 50, 'x'));
  CHECK(wired.fixes().empty());
  CHECK(wired.corrupt >= 1);
  wired.say("\r\n");
  CHECK(wired.fixes_of({}).size() == 1);
  CHECK(wired.driver.counts().broken == 3);
}

TEST_CASE("gpsd: a poll takes nothing from the heap, whatever comes", "[gpsd]") {
  Wired wired;
  Told told;
  std::uint64_t taken = 0;
  int fresh = 0;
  for (int i = 0; i < 20; ++i) {
    told.second = i;
    told.latitude_deg += 1e-6;
    wired.say(std::string{kGreeting} + "broken\r\n" + kOneDevice + tpv_line(told));
    const AllocationScope scope;
    for (int k = 0; k < 6; ++k) {
      fresh += wired.driver.poll(wired.now).status == ReadStatus::kFresh ? 1 : 0;
    }
    taken += scope.count();
    wired.pass(seconds{i % 5 == 4 ? 8 : 1});
  }
  CHECK(fresh == 20);
  CHECK(taken == 0);
}

}  // namespace
}  // namespace lodesman::testing
