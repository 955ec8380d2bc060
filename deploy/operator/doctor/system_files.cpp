// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/system_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

[[nodiscard]] bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

[[nodiscard]] std::string group_name(gid_t group, const fs::path& root) {
  std::string number = std::to_string(group);
  for (const std::string& line : lines_of(root / "etc/group")) {
    std::istringstream fields{line};
    std::array<std::string, 3> field;
    for (std::string& one : field) {
      std::getline(fields, one, ':');
    }
    if (field[2] == number) {
      return field[0];
    }
  }
  return number;
}

}  // namespace

bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream{file};
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(stream, line)) {
    lines.push_back(line);
  }
  return lines;
}

std::string first_line_of(const fs::path& file) {
  std::ifstream stream{file};
  std::string line;
  std::getline(stream, line);
  return line;
}

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

fs::path usb_device_of(const fs::path& terminal) {
  std::error_code error;
  fs::path place = fs::canonical(terminal / "device", error);
  for (; !error && place.has_relative_path(); place = place.parent_path()) {
    if (is_there(place / "idVendor")) {
      return place;
    }
  }
  return {};
}

bool is_usable(const fs::path& node) {
  return faccessat(AT_FDCWD, node.c_str(), R_OK | W_OK, AT_EACCESS) == 0;
}

std::string group_of(const fs::path& node, const fs::path& root) {
  struct stat status {};
  return stat(node.c_str(), &status) == 0 ? group_name(status.st_gid, root) : std::string{};
}

std::vector<PortHolder> holders_of(const std::string& node, const fs::path& root) {
  std::vector<PortHolder> holders;
  for (const fs::path& process : entries_of(root / "proc")) {
    if (!is_number(process.filename().string())) {
      continue;
    }
    const std::vector<fs::path> open = entries_of(process / "fd");
    if (std::any_of(open.begin(), open.end(), [&](const fs::path& descriptor) {
          std::error_code error;
          return fs::read_symlink(descriptor, error) == node;
        })) {
      const std::vector<std::string> name = lines_of(process / "comm");
      holders.push_back({name.empty() ? "?" : name.front(), process.filename().string()});
    }
  }
  return holders;
}

}  // namespace lodesman::cli
