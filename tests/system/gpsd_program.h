// SPDX-License-Identifier: Apache-2.0
// The gpsd that Debian ships, and its gpsfake, for tests that need them. Where one is missing the
// test is skipped, and with CI=true it fails, as with real data.
#pragma once

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <iostream>
#include <optional>
#include <string>

#include "drivers/stream/file_descriptor.h"
#include "tests/support/catch.h"
#include "tests/support/data_dir.h"

namespace lodesman::testing {

[[nodiscard]] inline std::optional<std::filesystem::path> installed(
    const std::string& program, const std::string& package,
    std::initializer_list<const char*> places) {
  for (const char* place : places) {
    if (access(place, X_OK) == 0) {
      return place;
    }
  }
  const std::string absent =
      "no " + program + " is installed (sudo apt-get install " + package + ")";
  if (data_is_required()) {
    FAIL("CI=true, and " << absent);
  }
  std::cout << "skipped: " << absent << "\n";
  return std::nullopt;
}

[[nodiscard]] inline std::optional<std::filesystem::path> gpsd_program() {
  const char* named = std::getenv("LODESMAN_GPSD");  // NOLINT(concurrency-mt-unsafe): nobody writes
  if (named != nullptr && *named != '\0') {
    return named;
  }
  return installed("gpsd", "gpsd", {"/usr/sbin/gpsd", "/usr/local/sbin/gpsd"});
}
[[nodiscard]] inline std::optional<std::filesystem::path> gpsfake_program() {
  return installed("gpsfake", "gpsd-clients", {"/usr/bin/gpsfake", "/usr/local/bin/gpsfake"});
}

// One that is free by now.
[[nodiscard]] inline std::string free_tcp_port() {
  const FileDescriptor trial{socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)};
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  auto* general = reinterpret_cast<sockaddr*>(&address);
  REQUIRE(bind(trial.value(), general, size) == 0);
  REQUIRE(getsockname(trial.value(), general, &size) == 0);
  return std::to_string(ntohs(address.sin_port));
}

}  // namespace lodesman::testing
