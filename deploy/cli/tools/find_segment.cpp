// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/tools/find_segment.h"

#include <algorithm>

#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

}  // namespace

std::vector<std::string> segments_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{directory, error}) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("lodesman-") && entry.is_regular_file(error)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::string choose_segment(const std::string& named, const std::vector<std::string>& found,
                           const std::vector<std::string>& alive) {
  if (!named.empty()) {
    return named.substr(named.find_last_of('/') + 1);
  }
  if (found.empty()) {
    throw StartupError("--segment: there is no /dev/shm/lodesman-*: is lodesman-low running?");
  }
  if (alive.size() == 1) {
    return alive.front();
  }
  if (found.size() == 1) {
    return found.front();
  }
  throw StartupError("--segment: name one of " + listed(alive.empty() ? found : alive) +
                     (alive.empty() ? " (none is alive)" : ""));
}

}  // namespace lodesman::cli
