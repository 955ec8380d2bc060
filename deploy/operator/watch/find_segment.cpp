// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/watch/find_segment.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

#include "mid_level/base/startup_error.h"
#include "mid_level/blackboard/segment.h"

namespace lodesman::cli {
namespace {

[[nodiscard]] std::string listed(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) {
    text += (text.empty() ? "" : ", ") + name;
  }
  return text;
}

// Programs lock the segment that they hold (ADR 0002); to ask, reading is enough.
[[nodiscard]] bool is_dead(const std::filesystem::path& segment) {
  const int file = open(segment.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  struct stat about {};
  struct flock any {};
  any.l_type = F_WRLCK;
  any.l_whence = SEEK_SET;
  const bool dead = file >= 0 && fstat(file, &about) == 0 && about.st_uid == geteuid() &&
                    fcntl(file, F_OFD_GETLK, &any) == 0 && any.l_type == F_UNLCK;
  if (file >= 0) {
    close(file);
  }
  return dead;
}

}  // namespace

std::vector<std::string> segments_in(const std::filesystem::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator{directory, error}) {
    const std::string name = entry.path().filename().string();
    if ((name == "lodesman" || name.starts_with("lodesman-")) && entry.is_regular_file(error)) {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> dead_segments_in(const std::filesystem::path& directory) {
  std::vector<std::string> names = segments_in(directory);
  std::erase_if(names, [&](const std::string& name) { return !is_dead(directory / name); });
  return names;
}

void remove_dead_runs() {
  for (const std::string& name : dead_segments_in("/dev/shm")) {
    if (name.starts_with("lodesman-sim-")) {
      remove_dead_segment(name);  // asks again, and holds it meanwhile
    }
  }
}

std::string choose_segment(const std::string& named, const std::vector<std::string>& found,
                           const std::vector<std::string>& alive) {
  if (!named.empty()) {
    return named.substr(named.find_last_of('/') + 1);
  }
  if (found.empty()) {
    throw NotYetError("--segment: there is no /dev/shm/lodesman*: is lodesman-low running?");
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
