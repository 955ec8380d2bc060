// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/bench/file_check.h"

#include "deploy/boat/configuration.h"
#include "deploy/boat/scenario_voyage.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] bool is_scenario(const TomlTable& root) {
  // The others are a scenario's too, and a configuration's never: a scenario that lacks [mission]
  // should be told so, not that it has unknown keys. Both have a [vehicle], with other keys.
  if (root.has("mission") || root.has("obstacle")) {
    return true;
  }
  if (!root.has("vehicle")) {
    return false;
  }
  const TomlTable vehicle = root.table("vehicle");
  return vehicle.has("surge_ref") || vehicle.has("speed_m_s") || vehicle.has("radius_m");
}

void check(const std::string& file, const CommonOptions& common, std::string& kind) {
  const TomlDocument document = TomlDocument::from_file(file);
  if (document.root().empty()) {
    throw StartupError(file, 1, "file", "says nothing");
  }
  if (is_scenario(document.root())) {
    kind = "scenario";
    (void)load_scenario(file, load_vessel_parameters());
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
  (void)load_configuration("default", with_file);
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
