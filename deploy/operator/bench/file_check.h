// SPDX-License-Identifier: Apache-2.0
// Whether a file is a valid scenario, vessel or configuration overlay, and if not, why not. One
// thread.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "deploy/boat/common_options.h"

namespace lodesman::cli {

struct FileCheck {
  std::string file;
  std::string kind;   // "scenario", "vessel", "configuration"; "unknown" where it cannot be read
  std::string error;  // one line `file:line: key: reason`; empty where all is well

  [[nodiscard]] bool ok() const noexcept { return error.empty(); }
  [[nodiscard]] nlohmann::ordered_json to_json() const;
};

// A file with [mission] is a scenario, one with [vessel] the simulated vessel. Any other is laid
// over default.toml and the overlays of `common`, as the programs would.
[[nodiscard]] FileCheck check_file(const std::string& file, const CommonOptions& common);

// For commands that read no configuration: what is given must be right all the same.
void refuse_bad_configuration(const CommonOptions& common);

}  // namespace lodesman::cli
