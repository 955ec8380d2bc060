// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/file_check.h"

#include <algorithm>

#include "deploy/boat/assembled_boat.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] bool is_scenario(const TomlTable& root) {
  // What a configuration never has: a scenario that lacks the rest should be told so, not that it
  // has unknown keys. Both have a [vehicle] and a [mission], with other keys.
  const auto has_one_of = [&root](const char* table, std::initializer_list<const char*> keys) {
    return root.has(table) && std::any_of(keys.begin(), keys.end(), [&](const char* key) {
             return root.table(table).has(key);
           });
  };
  return root.has("name") || root.has("time_limit_s") || root.has("obstacle") ||
         has_one_of("mission", {"start_m", "goal_m"}) ||
         has_one_of("vehicle", {"surge_ref", "speed_m_s", "radius_m"});
}

// Its keys alone, or in a table as a scenario has them, with nothing else beside it.
[[nodiscard]] bool is_mission(const TomlTable& root) {
  const auto has_goal = [](const TomlTable& table) {
    return table.has("goal_m") || table.has("goal_deg");
  };
  return has_goal(root) || (root.has("mission") && has_goal(root.table("mission")) &&
                            !root.table("mission").has("start_m") && !root.has("vehicle"));
}

// As the boat's programs look at it; a simulated one may get its scenario from elsewhere.
void check_configuration(const BoatConfig& config) {
  const bool simulated_elsewhere = config.simulation.scenario.empty() && is_simulated(config);
  if (!simulated_elsewhere) {
    const auto scenario = simulated_scenario(config);
    require_sound(config, scenario ? &*scenario : nullptr);
  }
}

void check(const std::string& file, const CommonOptions& common, std::string& kind) {
  const TomlDocument document = TomlDocument::from_file(file);
  if (document.root().empty()) {
    throw StartupError(file, 1, "file", "says nothing");
  }
  if (is_mission(document.root())) {
    kind = "mission";
    const TomlTable root = document.root();
    const bool in_table = root.has("mission");
    (void)read_mission(in_table ? root.table("mission") : root,
                       load_configuration("default", common).mission, nullptr);
    document.require_all_keys_read();
    return;
  }
  if (is_scenario(document.root())) {
    kind = "scenario";
    (void)load_scenario(file, load_configuration("default", common).speeds);
    return;
  }
  if (document.root().has("vessel")) {
    kind = "vessel";
    (void)load_vessel(file);
    return;
  }
  kind = "configuration";
  CommonOptions with_file = common;
  with_file.config_files.push_back(file);
  check_configuration(load_configuration("default", with_file));
}

}  // namespace

nlohmann::ordered_json FileCheck::to_json() const {
  using Json = nlohmann::ordered_json;
  return {
      {"file", file}, {"kind", kind}, {"ok", ok()}, {"error", ok() ? Json(nullptr) : Json(error)}};
}

FileCheck check_file(const std::string& file, const CommonOptions& common) {
  FileCheck result{file, "unknown", ""};
  try {
    check(file, common, result.kind);
  } catch (const StartupError& error) {
    result.error = error.what();
  }
  return result;
}

void refuse_bad_configuration(const CommonOptions& common) {
  if (!common.config_files.empty() || !common.sets.empty()) {
    (void)load_configuration("default", common);
  }
}

}  // namespace lodesman::cli
