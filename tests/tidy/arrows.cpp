// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <regex>
#include <string_view>

#include "tests/tidy/rules.h"

namespace lodesman::tidy {
namespace {

// What the files below `from` may include: a place that ends in '/' is all below it.
struct Arrow {
  std::string_view from;
  std::vector<std::string_view> to;
};

// The clock is no part of what tasks and pure rooms may see; see kClockHeader.
constexpr std::string_view kClockHeader = "mid_level/base/clock.h";

// The first row that fits counts, so exceptions stand before their room.
[[nodiscard]] const std::vector<Arrow>& arrows() {
  static const std::vector<Arrow> table{
      {"mid_level/base/", {"mid_level/base/"}},
      {"mid_level/messages/", {"mid_level/messages/", "mid_level/base/"}},
      {"mid_level/blackboard/",
       {"mid_level/blackboard/", "mid_level/messages/", "mid_level/base/"}},
      {"mid_level/runtime/",
       {"mid_level/runtime/", "mid_level/blackboard/", "mid_level/messages/", "mid_level/base/"}},
      {"mid_level/recording/",
       {"mid_level/recording/", "mid_level/blackboard/", "mid_level/messages/", "mid_level/base/"}},
      {"drivers/hal/", {"drivers/hal/", "mid_level/messages/", "mid_level/base/"}},
      {"drivers/serial/", {"drivers/serial/", "drivers/hal/", "mid_level/base/"}},
      {"low_level/sonar/", {"low_level/sonar/", "mid_level/messages/", "mid_level/base/"}},
      {"low_level/path/", {"low_level/path/", "mid_level/messages/", "mid_level/base/"}},
      {"low_level/thrust/", {"low_level/thrust/", "mid_level/messages/", "mid_level/base/"}},
      {"low_level/tasks/",
       {"low_level/", "drivers/hal/", "mid_level/blackboard/", "mid_level/runtime/task.h",
        "mid_level/runtime/task_table.h", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/estimate/", {"high_level/estimate/", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/guidance/", {"high_level/guidance/", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/control/", {"high_level/control/", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/mission/", {"high_level/mission/", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/tasks/",
       {"high_level/", "mid_level/blackboard/", "mid_level/runtime/task.h",
        "mid_level/runtime/task_table.h", "mid_level/messages/", "mid_level/base/"}},
      {"high_level/console/",
       {"high_level/console/", "high_level/mission/", "mid_level/blackboard/",
        "mid_level/messages/", "mid_level/base/"}},
      {"hal_sim/world/world_task.",
       {"hal_sim/world/", "drivers/hal/", "mid_level/blackboard/", "mid_level/runtime/task.h",
        "mid_level/messages/", "mid_level/base/"}},
      // The link between the world and its devices is made of channels.
      {"hal_sim/world/",
       {"hal_sim/world/", "drivers/hal/", "mid_level/blackboard/channel.h", "mid_level/messages/",
        "mid_level/base/"}},
      {"hal_sim/devices/",
       {"hal_sim/devices/", "hal_sim/world/", "drivers/hal/", "mid_level/blackboard/channel.h",
        "mid_level/messages/", "mid_level/base/"}},
      {"hal_sim/campaign/", {"hal_sim/campaign/", "mid_level/base/"}},
      {"hal_sim/emulators/",
       {"hal_sim/emulators/", "hal_sim/world/", "drivers/hal/", "mid_level/blackboard/channel.h",
        "mid_level/messages/", "mid_level/base/"}},
  };
  return table;
}

[[nodiscard]] bool is_within(std::string_view path, std::string_view place) {
  return place.ends_with('/') || place.ends_with('.') ? path.starts_with(place) : path == place;
}

[[nodiscard]] bool is_main(std::string_view path) {
  return path.substr(path.rfind('/') + 1).starts_with("main_");
}

[[nodiscard]] bool sees_the_clock(std::string_view path) {
  return path.starts_with("mid_level/") || path.starts_with("drivers/serial/") ||
         path.starts_with("high_level/console/");
}

[[nodiscard]] bool arrow_exists(std::string_view from, std::string_view to) {
  if (is_main(to)) {
    return false;
  }
  if (is_main(from) || from.starts_with("deploy/cli/") || from.starts_with("tests/")) {
    return !to.starts_with("tests/") || from.starts_with("tests/");
  }
  if (to == kClockHeader && !sees_the_clock(from)) {
    return false;
  }
  const auto& table = arrows();
  const auto row = std::find_if(table.begin(), table.end(),
                                [&](const Arrow& arrow) { return is_within(from, arrow.from); });
  if (row == table.end()) {
    // A device driver: its own room, the contracts, the byte stream.
    const auto own = from.substr(0, from.rfind('/') + 1);
    return from.starts_with("drivers/") &&
           (is_within(to, own) || is_within(to, "drivers/hal/") ||
            is_within(to, "drivers/serial/") || is_within(to, "mid_level/messages/") ||
            is_within(to, "mid_level/base/"));
  }
  return std::any_of(row->to.begin(), row->to.end(),
                     [&](std::string_view place) { return is_within(to, place); });
}

// Which rooms may include a library's headers. A library that is not named here is free.
struct Library {
  std::string_view header;
  std::vector<std::string_view> rooms;
};

[[nodiscard]] const std::vector<Library>& libraries() {
  static const std::vector<Library> table{
      {"opencv2/", {"low_level/sonar/"}},
      {"toml++/", {"mid_level/base/config/"}},
      {"GeographicLib/", {"mid_level/base/"}},
      {"boost/interprocess/", {"mid_level/blackboard/"}},
      {"boost/asio",
       {"high_level/mission/", "high_level/console/", "deploy/cli/", "drivers/", "hal_sim/"}},
      {"spdlog/",
       {"high_level/main_", "low_level/main_", "hal_sim/main_", "mid_level/recording/",
        "high_level/console/", "deploy/cli/"}},
      {"CLI/", {"deploy/cli/", "high_level/main_", "low_level/main_", "hal_sim/main_"}},
  };
  return table;
}

template <class Check>
[[nodiscard]] Findings over_includes(const SourceFile& file, const char* pattern, Check wrong) {
  Findings findings;
  const std::regex include{pattern};
  const auto lines = lines_of(file.text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (file.is_cpp() && std::regex_search(lines[i], match, include) && wrong(match[1].str())) {
      findings.push_back(file.path + ":" + std::to_string(i + 1) + ": may not include " +
                         match[1].str());
    }
  }
  return findings;
}

}  // namespace

Findings include_arrows(const SourceFile& file) {
  return over_includes(file, R"(^#include "([^"]+)\")",
                       [&](const std::string& to) { return !arrow_exists(file.path, to); });
}

Findings library_rooms(const SourceFile& file) {
  return over_includes(file, "^#include <([^>]+)>", [&](const std::string& header) {
    return !file.path.starts_with("tests/") &&
           std::any_of(libraries().begin(), libraries().end(), [&](const Library& library) {
             return header.starts_with(library.header) &&
                    std::none_of(
                        library.rooms.begin(), library.rooms.end(),
                        [&](std::string_view room) { return file.path.starts_with(room); });
           });
  });
}

}  // namespace lodesman::tidy
