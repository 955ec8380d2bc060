// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <regex>
#include <string_view>

#include "tests/tidy/rules.h"

namespace lodesman::tidy {
namespace {

// The clock is no part of what tasks and pure rooms may see.
constexpr std::string_view kClockHeader = "mid_level/base/clock.h";

// Task and table, without what runs them.
constexpr std::string_view kTask = "mid_level/runtime/task.h";
constexpr std::string_view kTaskTable = "mid_level/runtime/task_table.h";

[[nodiscard]] bool is_within(std::string_view path, std::string_view place) {
  return place.empty() || path == place ||
         (path.starts_with(place) && path.substr(place.size()).starts_with('/'));
}

[[nodiscard]] bool is_main(std::string_view path) {
  return path.substr(path.rfind('/') + 1).starts_with("main_");
}

[[nodiscard]] bool sees_the_clock(std::string_view path) {
  return path.starts_with("mid_level/") || path.starts_with("drivers/stream/") ||
         path.starts_with("deploy/") || path.starts_with("tests/");
}

[[nodiscard]] bool arrow_exists(std::string_view from, std::string_view to) {
  if (is_main(to) || (to == kClockHeader && !sees_the_clock(from))) {
    return false;
  }
  return std::any_of(arrows().begin(), arrows().end(), [&](const Arrow& arrow) {
    return is_within(from, arrow.room) &&
           (is_within(to, arrow.room) || is_within(to, "mid_level/base") ||
            std::any_of(arrow.may_include.begin(), arrow.may_include.end(),
                        [&](std::string_view place) { return is_within(to, place); }));
  });
}

// Which rooms may include a library's headers. A library that is not named here is free.
struct Library {
  std::string_view header;
  std::vector<std::string_view> rooms;
};

[[nodiscard]] const std::vector<Library>& libraries() {
  static const std::vector<Library> table{
      {"opencv2/", {"low_level/sonar/"}},
      {"png.h", {"low_level/sonar/"}},
      {"turbojpeg.h", {"low_level/sonar/", "mid_level/recording/"}},
      {"zlib.h", {"mid_level/recording/"}},
      {"zstd.h", {"mid_level/recording/"}},
      {"toml++/", {"mid_level/config/"}},
      {"GeographicLib/", {"mid_level/base/"}},
      {"boost/interprocess/", {"mid_level/blackboard/"}},
      {"libserialport.h", {"drivers/stream/"}},
      {"libusb.h", {"deploy/operator/doctor/"}},
      {"sodium.h", {"high_level/mission/"}},
      {"boost/asio", {"high_level/mission/", "deploy/operator/", "drivers/", "hal_sim/"}},
      {"spdlog/", {"deploy/boat/"}},
      {"systemd/", {"deploy/boat/"}},
      {"CLI/", {"deploy/"}},
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

const std::vector<Arrow>& arrows() {
  static const std::vector<Arrow> table{
      {"mid_level/base", {}},
      {"mid_level/config", {"mid_level/messages"}},
      {"mid_level/messages", {}},
      {"mid_level/geometry", {"mid_level/messages"}},
      {"mid_level/blackboard", {"mid_level/messages"}},
      {"mid_level/runtime", {"mid_level/blackboard", "mid_level/messages"}},
      {"mid_level/recording", {"mid_level/blackboard", "mid_level/messages"}},
      {"drivers/hal", {"mid_level/messages"}},
      {"drivers/stream", {"mid_level/messages"}},
      {"drivers/nav440", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"drivers/delta_t", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"drivers/nmea", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"drivers/gpsd", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"drivers/maestro", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"drivers/roboclaw", {"drivers/hal", "drivers/stream", "mid_level/messages"}},
      {"low_level/sonar", {"mid_level/geometry", "mid_level/messages"}},
      {"low_level/tracking", {"low_level/sonar", "mid_level/geometry", "mid_level/messages"}},
      {"low_level/path", {"mid_level/geometry", "mid_level/messages"}},
      {"low_level/thrust", {"mid_level/messages"}},
      {"low_level/tasks",
       {"low_level/sonar", "low_level/tracking", "low_level/path", "low_level/thrust",
        "drivers/hal", "mid_level/blackboard", kTask, kTaskTable, "mid_level/geometry",
        "mid_level/messages"}},
      {"high_level/estimate", {"mid_level/geometry", "mid_level/messages"}},
      {"high_level/guidance",
       {"high_level/control", "high_level/estimate/vehicle_model.h", "mid_level/geometry",
        "mid_level/messages"}},
      {"high_level/control", {"mid_level/messages"}},
      {"high_level/mission", {"mid_level/geometry", "mid_level/messages"}},
      {"high_level/tasks",
       {"high_level/estimate", "high_level/guidance", "high_level/control", "high_level/mission",
        "mid_level/blackboard", "mid_level/config", kTask, kTaskTable, "mid_level/geometry",
        "mid_level/messages"}},
      {"hal_sim/scenario", {"mid_level/config", "mid_level/geometry", "mid_level/messages"}},
      {"hal_sim/world",
       {"hal_sim/scenario", "drivers/hal", "mid_level/blackboard", kTask, "mid_level/geometry",
        "mid_level/messages"}},
      {"hal_sim/sonar", {"hal_sim/scenario", "mid_level/geometry", "mid_level/messages"}},
      {"hal_sim/devices",
       {"hal_sim/world", "hal_sim/sonar", "hal_sim/scenario", "drivers/hal", "mid_level/blackboard",
        "mid_level/geometry", "mid_level/messages"}},
      {"hal_sim/emulators",
       {"hal_sim/world", "hal_sim/sonar", "hal_sim/scenario", "drivers/hal", "drivers/stream",
        "mid_level/blackboard", kTask, "mid_level/geometry", "mid_level/messages"}},
      {"hal_sim/campaign", {}},
      {"deploy/boat",
       {"low_level/tasks", "low_level/thrust", "high_level/tasks", "high_level/mission", "hal_sim",
        "drivers", "mid_level"}},
      {"deploy/operator/report", {"mid_level/geometry", "mid_level/messages"}},
      {"deploy/operator/recorder", {"deploy/boat", "mid_level"}},
      {"deploy/operator/console", {"deploy/boat", "high_level/mission", "mid_level"}},
      {"deploy/operator/run",
       {"deploy/boat", "deploy/operator/recorder", "deploy/operator/report", "hal_sim/scenario",
        "mid_level"}},
      {"deploy/operator/replay",
       {"deploy/boat", "drivers/hal", "hal_sim/scenario", "high_level/tasks", "low_level/tasks",
        "mid_level"}},
      {"deploy/operator/watch", {"mid_level"}},
      {"deploy/operator/doctor", {"deploy/boat", "deploy/operator/watch", "drivers", "mid_level"}},
      {"deploy/operator/bench", {"deploy/boat", "low_level/path", "mid_level"}},
      {"deploy/operator/calibrate", {"mid_level"}},
      {"deploy/operator/decode", {"drivers", "mid_level"}},
      {"deploy/operator/rt_test",
       {"deploy/boat", "deploy/operator/report", "deploy/operator/run", "hal_sim/scenario",
        "mid_level"}},
      {"deploy/operator/cli",
       {"deploy/boat", "deploy/operator", "hal_sim/scenario", "hal_sim/campaign",
        "high_level/mission", "low_level/path", "low_level/sonar", "low_level/tracking",
        "mid_level"}},
      {"tests", {""}},
  };
  return table;
}

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
