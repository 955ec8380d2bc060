// SPDX-License-Identifier: Apache-2.0
// A pipe that nobody reads.
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <string>

#include "tests/support/catch.h"

namespace lodesman::testing {

class Pipe {
 public:
  Pipe() { REQUIRE(pipe2(ends_.data(), O_CLOEXEC) == 0); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close_reader();
    close(ends_[1]);
  }

  void fill() const {
    const int end = open(("/proc/self/fd/" + std::to_string(ends_[1])).c_str(),
                         O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(end >= 0);
    const std::string page(4096, '.');
    while (write(end, page.data(), page.size()) > 0) {
    }
    close(end);
  }
  // What has been written and not yet read, up to 64 KiB.
  [[nodiscard]] std::string read_some() const {
    std::string text(65536, '\0');
    const ssize_t count = read(ends_[0], text.data(), text.size());
    text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return text;
  }
  void close_reader() {
    if (ends_[0] >= 0) {
      close(ends_[0]);
      ends_[0] = -1;
    }
  }
  [[nodiscard]] int writer() const { return ends_[1]; }

 private:
  std::array<int, 2> ends_{};
};

}  // namespace lodesman::testing
