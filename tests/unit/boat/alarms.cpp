// SPDX-License-Identifier: Apache-2.0
// docs/alarms.md has each name that the programs can say of the boat, and no other.
#include <fstream>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "deploy/boat/exit_status.h"
#include "high_level/tasks/readiness.h"
#include "high_level/tasks/thrust_desk.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

using Names = std::set<std::string>;

[[nodiscard]] std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream{path}.rdbuf();
  REQUIRE_FALSE(text.str().empty());
  return text.str();
}

[[nodiscard]] const std::string& page() {
  static const std::string text = text_of(LODESMAN_SOURCE "/docs/alarms.md");
  return text;
}

// Of the table whose first column has that head: what its rows begin with.
[[nodiscard]] Names rows_of(const std::string& head) {
  std::istringstream lines{page()};
  std::string line;
  while (std::getline(lines, line) && !line.starts_with("| " + head + " |")) {
  }
  Names names;
  while (std::getline(lines, line) && line.starts_with("|")) {
    const std::string name = line.substr(2, line.find(" |") - 2);
    if (!line.starts_with("|---")) {
      CHECK(names.insert(name).second);
    }
  }
  return names;
}

template <class E>
[[nodiscard]] Names names_of() {
  Names names;
  for (const char* name : enumerators(E{})) {
    names.insert(std::string{"`"} + name + "`");
  }
  return names;
}

// Without comments and includes, and with literals joined as the compiler joins them.
[[nodiscard]] std::string plain(const std::string& source) {
  static const std::regex kNoWords{R"(//[^\n]*|#include[^\n]*|"\s*\n\s*")"};
  return std::regex_replace(source, kNoWords, "");
}

// The literals of a source in the pieces that stand between what is filled in: those that are
// words.
[[nodiscard]] std::vector<std::string> words_in(const std::string& source) {
  static const std::regex kLiteral{R"re("((?:[^"\\\n]|\\.)*)")re"};
  static const std::regex kFilledIn{R"(\{[^}]*\}|%[.0-9]*[a-z]|\\.)"};
  std::vector<std::string> all;
  for (std::sregex_iterator it{source.begin(), source.end(), kLiteral};
       it != std::sregex_iterator{}; ++it) {
    const std::string literal = (*it)[1];
    for (std::sregex_token_iterator piece{literal.begin(), literal.end(), kFilledIn, -1};
         piece != std::sregex_token_iterator{}; ++piece) {
      const std::string text = *piece;
      const auto begin = text.find_first_not_of(" :;,(");
      const auto end = text.find_last_not_of(" :;,(");
      if (begin != std::string::npos && text.find(' ', begin) < end) {
        all.push_back(text.substr(begin, end - begin + 1));
      }
    }
  }
  return all;
}

[[nodiscard]] std::string source_of(const std::string& path) {
  return plain(text_of(LODESMAN_SOURCE "/" + path));
}

// The calls of the log alone.
[[nodiscard]] std::string log_calls(const std::string& source) {
  static const std::regex kCall{
      R"re(spdlog::(info|warn|error)\((?:[^;"]|"(?:[^"\\]|\\.)*")*\);)re"};
  std::string calls;
  for (std::sregex_iterator it{source.begin(), source.end(), kCall}; it != std::sregex_iterator{};
       ++it) {
    calls += it->str() + '\n';
  }
  return calls;
}

// What of it the page does not say.
[[nodiscard]] std::vector<std::string> untold(const std::string& source) {
  std::vector<std::string> missing;
  for (const std::string& words : words_in(source)) {
    if (page().find(words) == std::string::npos) {
      missing.push_back(words);
    }
  }
  return missing;
}

void require_told(const std::string& source) {
  REQUIRE_FALSE(words_in(source).empty());
  for (const std::string& words : untold(source)) {
    FAIL_CHECK("docs/alarms.md does not say: " << words);
  }
}

}  // namespace

TEST_CASE("docs: the tables of alarms have the program's own names and no others", "[docs]") {
  CHECK(rows_of("`state`") == names_of<MissionState>());
  CHECK(rows_of("`cause`") == names_of<MissionCause>());
  CHECK(rows_of("`thrust.state`") == names_of<ThrustState>());
  CHECK(rows_of("`thrust.cause`") == names_of<ThrustCause>());
  CHECK(rows_of("why thrust is as it is (`thrust_applied` in `lodesman watch`)") ==
        names_of<ThrustReason>());
  CHECK(rows_of("`battery.level`") == names_of<BatteryLevel>());
  CHECK(rows_of("`guard.state`") == names_of<GuardState>());
  CHECK(rows_of("`guard.last_trip.reason`") == names_of<GuardReason>());
  CHECK(rows_of("`no_way.cause`") == names_of<NoWayCause>());
  CHECK(rows_of("`helm`") == names_of<HelmReason>());
  CHECK(rows_of("`plan.reason`") == names_of<PathReason>());
  CHECK(rows_of("`plan.rung`") == names_of<PlanRung>());
  CHECK(rows_of("`plan.waypoints`") == names_of<WaypointSource>());
  CHECK(rows_of("`position_trust`") == names_of<PositionTrust>());
  CHECK(rows_of("`status` of a device") == names_of<DeviceStatus>());
  CHECK(rows_of("`fault`") == names_of<DeviceFault>());
}

TEST_CASE("docs: each thing that an arm or a start is refused for has its row", "[docs]") {
  const Names rows = rows_of("refused because");
  for (const std::string& objection : in_words(~0U, nullptr)) {
    INFO(objection);
    CHECK(rows.count(objection) == 1);
  }
  const auto board = std::make_unique<Blackboard>();
  const Time now{std::chrono::seconds{100}};
  Writer<ThrustApplied> applied{board->thrust_applied, Role::kLow, "thrust_applied"};
  Writer<ThrustStatus> arming{board->thrust_status, Role::kLow, "thrust_status"};
  Readiness readiness{*board, false};
  std::vector<std::string> reasons = readiness.reasons(now);
  CHECK(reasons.size() == 4);
  ThrustStatus off;
  off.objections = bit(ArmObjection::kBoxGone);
  applied.publish({}, now);
  arming.publish(off, now);
  for (const std::string& reason : readiness.reasons(now)) {
    reasons.push_back(reason);
  }
  CHECK(reasons.size() == 9);
  for (const std::string& reason : reasons) {
    INFO(reason);
    CHECK(rows.count(reason) == 1);
  }
}

TEST_CASE("docs: what the operator's desk can answer is among the alarms", "[docs]") {
  for (const char* source :
       {"high_level/tasks/operator_desk.cpp", "high_level/tasks/desk_replies.cpp",
        "high_level/tasks/thrust_desk.cpp", "high_level/tasks/readiness.cpp",
        "high_level/tasks/tuning.cpp", "high_level/mission/commander.cpp",
        "high_level/mission/command_line.cpp"}) {
    require_told(source_of(source));
  }
}

TEST_CASE("docs: each line that the boat's programs log is among the alarms", "[docs]") {
  for (const char* source : {"deploy/boat/device_watch.cpp", "mid_level/runtime/health_watch.cpp",
                             "deploy/boat/latch_file.cpp", "deploy/boat/status_line.cpp"}) {
    require_told(source_of(source));
  }
  for (const char* source :
       {"deploy/boat/main_low.cpp", "deploy/boat/main_high.cpp", "deploy/boat/process_main.cpp"}) {
    require_told(log_calls(source_of(source)));
  }
}

TEST_CASE("docs: the fields of the journal and the exit statuses are among the alarms", "[docs]") {
  const std::string watch = text_of(LODESMAN_SOURCE "/deploy/boat/device_watch.cpp");
  static const std::regex kField{R"(LODESMAN_[A-Z]+)"};
  Names fields;
  for (std::sregex_iterator it{watch.begin(), watch.end(), kField}; it != std::sregex_iterator{};
       ++it) {
    fields.insert('`' + it->str() + '`');
  }
  CHECK(rows_of("field") == fields);
  const Names statuses = rows_of("status");
  for (const int status :
       {kExitDone, kExitNoGoal, kExitRefused, kExitCollision, kExitFault, kExitNotYet}) {
    CHECK(statuses.count(std::to_string(status)) == 1);
  }
}

TEST_CASE("docs: a line of the log that is told nowhere is found", "[docs]") {
  const std::string calls = log_calls(
      plain("// spdlog::warn(\"not this\");\n  spdlog::warn(\"the keel {}\"\n \" has come off; "
            "{:.1f}\", a(b));\n"
            "  other(\"nor that\");"));
  CHECK(words_in(calls) == std::vector<std::string>{"the keel", "has come off"});
  CHECK(untold(calls) == std::vector<std::string>{"the keel", "has come off"});
  CHECK(untold("log(\"sees again\")").empty());
}
