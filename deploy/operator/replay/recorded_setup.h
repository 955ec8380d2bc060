// SPDX-License-Identifier: Apache-2.0
// How the boat of a recording was set up, by what stands in its first file; and what is to be
// otherwise. One thread; StartupError says what cannot be read.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "deploy/operator/replay/fed_board.h"
#include "deploy/operator/replay/stepped_task.h"

namespace lodesman::cli {

struct RecordedSetup {
  std::map<std::string, std::string> about;
  ReplayOptions options;
  TunablesChange change;  // what of the tunables `sets` changed
};

[[nodiscard]] RecordedSetup recorded_setup(const std::filesystem::path& file,
                                           const std::vector<std::string>& sets);

}  // namespace lodesman::cli
