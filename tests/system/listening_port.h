// SPDX-License-Identifier: Apache-2.0
// Which TCP port a process listens on, where it let the kernel choose one (port 0): so no two tests
// ever want the same.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

namespace lodesman::testing {

// The inodes of the sockets that a process holds, as /proc/net/tcp names them.
inline std::set<std::string> sockets_of(pid_t process) {
  std::set<std::string> inodes;
  std::error_code gone;
  const std::string files = "/proc/" + std::to_string(process) + "/fd";
  for (const auto& file : std::filesystem::directory_iterator{files, gone}) {
    const std::string target = std::filesystem::read_symlink(file.path(), gone).string();
    if (const std::string kind = "socket:["; target.starts_with(kind)) {
      inodes.insert(target.substr(kind.size(), target.size() - kind.size() - 1));
    }
  }
  return inodes;
}

// 0 where the process listens on none yet.
inline int listening_port(pid_t process) {
  constexpr const char* kListening = "0A";
  const std::set<std::string> inodes = sockets_of(process);
  std::ifstream table{"/proc/net/tcp"};
  std::string line;
  std::getline(table, line);  // the heading
  while (std::getline(table, line)) {
    std::istringstream columns{line};
    std::string slot, local, remote, state, queues, timer, retries, user, timeout, inode;
    columns >> slot >> local >> remote >> state >> queues >> timer >> retries >> user >> timeout >>
        inode;
    if (state == kListening && inodes.count(inode) > 0) {
      return std::stoi(local.substr(local.find(':') + 1), nullptr, 16);
    }
  }
  return 0;
}

}  // namespace lodesman::testing
