// SPDX-License-Identifier: Apache-2.0
// A device at the other end of a pty, found by a link of its own that stays where it is while the
// device comes and goes, as udev's links do. One thread, but for what says otherwise.
#pragma once

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <thread>

#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {

// A bound for what must not hang; nothing is judged by how soon it comes.
[[nodiscard]] inline bool eventually(const std::function<bool()>& holds,
                                     std::chrono::seconds limit = std::chrono::seconds{10}) {
  const auto until = std::chrono::steady_clock::now() + limit;
  while (!holds()) {
    if (std::chrono::steady_clock::now() >= until) {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds{1});
  }
  return true;
}

class PtyDevice {
 public:
  PtyDevice() { plug(); }
  PtyDevice(const PtyDevice&) = delete;
  PtyDevice& operator=(const PtyDevice&) = delete;
  ~PtyDevice() { unplug(); }

  [[nodiscard]] std::string path() const { return (folder_.path() / "device").string(); }
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  [[nodiscard]] const std::string& node() const { return node_; }
  [[nodiscard]] int master() const { return master_; }

  // A new pty, its settings as the kernel makes them: echo, lines, flow control. The old one, where
  // there is one, stays as it is.
  void plug() {
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    REQUIRE(master_ >= 0);
    REQUIRE(grantpt(master_) == 0);
    REQUIRE(unlockpt(master_) == 0);
    std::array<char, 64> name{};
    REQUIRE(ptsname_r(master_, name.data(), name.size()) == 0);
    node_ = name.data();
    point_link_at(node_);
  }
  // The link goes first: the number of a pty that is closed is given to others.
  void unplug() {
    std::error_code ignored;
    std::filesystem::remove(path(), ignored);
    hang_up();
  }
  // The link stays and leads nowhere, or to somebody else.
  void hang_up() {
    if (master_ >= 0) {
      close(master_);
      master_ = -1;
    }
  }
  void point_link_at(const std::string& target) const {
    const std::filesystem::path fresh = folder_.path() / "fresh";
    std::filesystem::create_symlink(target, fresh);
    std::filesystem::rename(fresh, path());
  }

  // How many were taken; beside another thread that receives.
  std::size_t send(std::span<const std::uint8_t> bytes) const {
    const ssize_t count = write(master_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  std::size_t receive(std::span<std::uint8_t> into) const {
    const ssize_t count = read(master_, into.data(), into.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  // As whoever has the port has set it.
  [[nodiscard]] termios settings() const {
    termios now{};
    REQUIRE(tcgetattr(master_, &now) == 0);
    return now;
  }

 private:
  TemporaryDirectory folder_;
  std::string node_;
  int master_ = -1;
};

}  // namespace lodesman::testing
