// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>
#include <stdexcept>

#include "tests/support/catch.h"
#include "tests/tidy/symbols.h"

namespace lodesman::tidy {
namespace {

[[nodiscard]] std::string nm_of(const std::string& library) {
  const std::string command = LODESMAN_NM " -A -u --demangle '" + library + "' 2>/dev/null";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  char piece[4096];
  for (std::size_t size = 1; size > 0;) {
    size = std::fread(piece, 1, sizeof piece, pipe);
    output.append(piece, size);
  }
  REQUIRE(::pclose(pipe) == 0);
  return output;
}

// What speaks with people is exempt whether it makes use of that or not.
constexpr std::string_view kOperator = "deploy";

struct Room {
  std::string name;
  std::vector<NeededSymbol> symbols;
};

// Every room's library, as the build names it.
[[nodiscard]] std::vector<Room> read_rooms() {
  std::vector<Room> rooms;
  std::ifstream list{LODESMAN_ROOMS_FILE};
  std::string name;
  std::string library;
  while (list >> name && std::getline(list >> std::ws, library)) {
    rooms.push_back({name, needed_symbols(name, nm_of(library))});
  }
  return rooms;
}

[[nodiscard]] const SymbolRule& rule_named(std::string_view name) {
  const auto& rules = symbol_rules();
  return *std::find_if(rules.begin(), rules.end(),
                       [&](const SymbolRule& rule) { return rule.name == name; });
}

}  // namespace

TEST_CASE("rooms: nothing is called that has no place in a room", "[tidy]") {
  const auto rooms = read_rooms();
  REQUIRE(rooms.size() > 20);
  // A room may need nothing at all, but not most of them.
  CHECK(std::count_if(rooms.begin(), rooms.end(),
                      [](const Room& room) { return !room.symbols.empty(); }) > 20);
  for (const Room& room : rooms) {
    for (const SymbolRule& rule : symbol_rules()) {
      for (const std::string& finding : forbidden_symbols(rule, room.symbols)) {
        FAIL_CHECK(rule.name << ": " << finding);
      }
    }
  }
}

TEST_CASE("rooms: every exemption is made use of, and every place named is one", "[tidy]") {
  std::vector<NeededSymbol> all;
  for (const Room& room : read_rooms()) {
    all.insert(all.end(), room.symbols.begin(), room.symbols.end());
  }
  for (const SymbolRule& rule : symbol_rules()) {
    for (const std::string_view exempted : rule.but_for) {
      INFO(rule.name << " in " << exempted);
      const auto needed = forbidden_symbols({rule.name, rule.pattern, {exempted}, {}}, all);
      CHECK((exempted == kOperator || !needed.empty()));
    }
    for (const std::string_view place : rule.places) {
      INFO(rule.name << " in " << place);
      CHECK(!forbidden_symbols({rule.name, ".*", {place}, {}}, all).empty());
    }
  }
}

// The library of forbidden_calls.cpp, in a room that may do nothing of the kind.
TEST_CASE("rooms: each forbidden call is seen in what the compiler made of it", "[tidy]") {
  const auto symbols = needed_symbols("low_level/thrust", nm_of(LODESMAN_FORBIDDEN_CALLS));
  const auto found = [&](const char* rule) {
    std::set<std::string> needed;
    for (const std::string& finding : forbidden_symbols(rule_named(rule), symbols)) {
      needed.insert(finding.substr(0, finding.find('(')));
    }
    return needed;
  };
  const std::string here = "low_level/thrust/forbidden_calls.cpp: needs ";
  CHECK(found("clocks and waits").contains(here + "std::chrono::_V2::steady_clock::now"));
  CHECK(found("clocks and waits").contains(here + "nanosleep"));
  CHECK(found("clocks and waits").contains(here + "syscall"));
  CHECK(found("locks").contains(here + "pthread_mutex_lock"));
  CHECK(found("locks").contains(here + "std::condition_variable::notify_all"));
  CHECK(found("threads").contains(here + "std::thread::_M_start_thread"));
  CHECK(!found("log calls").empty());  // printf by another name, where one is cheaper
  CHECK(found("chance").contains(here + "rand"));
  CHECK(found("chance").size() > 1);  // and the device
  CHECK(found("allocations").contains(here + "operator new"));
}

TEST_CASE("rooms: a symbol is forbidden in its places alone", "[tidy]") {
  const std::string nm =
      "lib.a[a.cpp.o]: U operator new(unsigned long)\n"
      "some/lib.a:b.cpp.o:                 U nanosleep@GLIBC_2.17\n"
      "some/lib.a:b.cpp.o:                 w time\n"
      "some/lib.a:b.cpp.o:                 U time_of(int)\n"
      "some/lib.a:b.cpp.o:                 U snprintf\n";
  const auto findings = [&](const char* rule, const char* room) {
    return forbidden_symbols(rule_named(rule), needed_symbols(room, nm));
  };
  CHECK(findings("allocations", "low_level/thrust") ==
        Findings{"low_level/thrust/a.cpp: needs operator new(unsigned long)"});
  CHECK(findings("allocations", "low_level/thrust_too").empty());
  CHECK(findings("clocks and waits", "low_level/path") ==
        Findings{"low_level/path/b.cpp: needs nanosleep", "low_level/path/b.cpp: needs time"});
  CHECK(findings("clocks and waits", "deploy/boat").empty());
  CHECK(findings("log calls", "low_level/path").empty());
}

}  // namespace lodesman::tidy
