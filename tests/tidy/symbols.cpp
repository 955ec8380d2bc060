// SPDX-License-Identifier: Apache-2.0
#include "tests/tidy/symbols.h"

#include <algorithm>
#include <regex>

namespace lodesman::tidy {
namespace {

using Places = std::vector<std::string_view>;

[[nodiscard]] bool is_within(std::string_view source, const Places& places) {
  return std::any_of(places.begin(), places.end(), [&](std::string_view place) {
    return place.empty() || source == place ||
           (source.starts_with(place) && source.substr(place.size()).starts_with('/'));
  });
}

}  // namespace

const std::vector<SymbolRule>& symbol_rules() {
  // Boost.Asio has a clock, locks and a thread of its own.
  constexpr std::string_view kAsio = "high_level/mission/command_socket.cpp";
  constexpr std::string_view kAsioLines = "high_level/mission/command_session.cpp";
  constexpr std::string_view kOperator = "deploy";
  static const std::vector<SymbolRule> rules{
      {"clocks and waits",
       R"(std::chrono::_V2::\w+::now\(\)|(clock_)?(gettime|nanosleep)|gettimeofday|u?sleep|time)"
       R"(|timerfd_\w+|syscall|p?poll|p?select|epoll_\w*wait)",
       {""},
       {"mid_level/base/clock.cpp", "mid_level/blackboard/bell.cpp",
        "mid_level/blackboard/segment.cpp", "drivers/stream/reconnecting_line.cpp",
        "drivers/stream/tcp_port.cpp", "drivers/stream/udp_socket.cpp",
        "hal_sim/emulators/device_port.cpp", kAsio, kAsioLines, kOperator}},
      {"locks",
       R"(pthread_(mutex|rwlock|cond|spin|barrier|once)\w*|sem_\w+|__cxa_guard_acquire)"
       R"(|std::(condition_variable|__once|mutex|shared_mutex|recursive_mutex)\b.*)",
       {""},
       {kAsio, kAsioLines, kOperator}},
      {"threads",
       R"(pthread_create|std::thread::_M_start_thread\(.*|thrd_create|fork|vfork|clone)",
       {""},
       {"mid_level/runtime", "drivers/stream/reconnecting_line.cpp",
        "drivers/stream/udp_socket.cpp", kAsio, kAsioLines, kOperator}},
      // check.cpp says why it ends the process.
      {"log calls",
       R"(spdlog::.*|fmt::\w+::v?print.*|std::c(out|err|log)|(__)?v?[fd]?printf(_chk)?|f?puts)"
       R"(|f?putc|putchar|fwrite|perror|v?syslog)",
       {""},
       {"mid_level/base/check.cpp", kOperator}},
      {"chance",
       R"(s?rand(om)?|rand_r|[a-z]rand48|std::random_device::.*|getrandom|getentropy)"
       R"(|randombytes_\w+)",
       {""},
       // Beast's WebSocket makes masks and keys of a client by it, which a server uses of neither.
       {"high_level/mission/token_file.cpp", "high_level/mission/message_code.cpp",
        "deploy/operator/console/console_server.cpp"}},
      // Where nothing at all is allocated, not even at the start. Of the others' work in each
      // period tests count what is: see tests/support/allocations.h.
      {"allocations",
       R"(operator new.*|[mc]alloc|realloc|aligned_alloc|posix_memalign)"
       R"(|std::__cxx11::basic_string<.*)",
       {"mid_level/geometry", "low_level/thrust", "low_level/tasks/sensors.cpp",
        "low_level/tasks/thruster.cpp", "low_level/sonar/blob.cpp",
        "low_level/sonar/known_obstacles.cpp", "low_level/sonar/protection.cpp",
        "high_level/control", "high_level/estimate", "high_level/guidance/manoeuvre.cpp",
        "high_level/guidance/rollout.cpp", "high_level/guidance/route.cpp",
        "high_level/guidance/steering.cpp", "high_level/guidance/waypoints.cpp",
        "high_level/guidance/zones.cpp"},
       {}},
  };
  return rules;
}

// Lines such as "lib.a:grid.cpp.o:         U operator new(unsigned long)"; the rest are headings.
std::vector<NeededSymbol> needed_symbols(const std::string& room, const std::string& nm_output) {
  static const std::regex line_of_nm{R"(^.*[:\[]([^:\[\]/]+)\.o\]?:\s+[UwWvV]\s+(.*)$)"};
  std::vector<NeededSymbol> symbols;
  for (const std::string& line : lines_of(nm_output)) {
    std::smatch match;
    if (std::regex_match(line, match, line_of_nm)) {
      std::string symbol = match[2].str();
      symbol.resize(std::min(symbol.find('@'), symbol.size()));  // the version of a library's own
      symbols.push_back({room + "/" + match[1].str(), symbol});
    }
  }
  return symbols;
}

Findings forbidden_symbols(const SymbolRule& rule, const std::vector<NeededSymbol>& symbols) {
  const std::regex pattern{rule.pattern};
  Findings findings;
  for (const auto& [source, symbol] : symbols) {
    if (is_within(source, rule.places) && !is_within(source, rule.but_for) &&
        std::regex_match(symbol, pattern)) {
      findings.push_back(source + ": needs " + symbol);
    }
  }
  return findings;
}

}  // namespace lodesman::tidy
