// SPDX-License-Identifier: Apache-2.0
// A datagram socket in a directory of its own, in the place of a service manager or a journal.
#pragma once

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <string>

#include "tests/support/catch.h"

namespace lodesman::testing {

class UnixListener {
 public:
  UnixListener() {
    std::filesystem::create_directory(directory_);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    REQUIRE(path().size() < sizeof address.sun_path);
    std::strncpy(address.sun_path, path().c_str(), sizeof address.sun_path - 1);
    file_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    REQUIRE(bind(file_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  }
  UnixListener(const UnixListener&) = delete;
  UnixListener& operator=(const UnixListener&) = delete;
  ~UnixListener() {
    close(file_);
    std::filesystem::remove_all(directory_);
  }

  [[nodiscard]] std::string path() const { return (directory_ / "socket").string(); }
  // The oldest that was not yet heard; empty where there is none.
  [[nodiscard]] std::string hear() const {
    std::array<char, 4096> text{};
    const ssize_t length = recv(file_, text.data(), text.size(), 0);
    return {text.data(), length > 0 ? static_cast<std::size_t>(length) : 0U};
  }

 private:
  std::filesystem::path directory_ =
      std::filesystem::temp_directory_path() / ("lodesman-listener-" + std::to_string(getpid()));
  int file_ = -1;
};

}  // namespace lodesman::testing
