// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/device_port.h"

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

namespace fs = std::filesystem;

struct Speed {
  speed_t code;
  int baud;
};
constexpr std::array<Speed, 5> kSpeeds{
    {{B9600, 9600}, {B19200, 19200}, {B38400, 38400}, {B57600, 57600}, {B115200, 115200}}};

class PtyLine final : public HostLine {
 public:
  explicit PtyLine(fs::path name) : name_{std::move(name)} {
    plug();
    if (master_ < 0) {
      throw StartupError(name_.string() + ": no pty can be made there");
    }
  }
  PtyLine(const PtyLine&) = delete;
  PtyLine& operator=(const PtyLine&) = delete;
  ~PtyLine() override { unplug(); }

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) override {
    const ssize_t count = ::read(master_, into.data(), into.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;  // nobody has it open: an error
  }
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes) override {
    const ssize_t count = ::write(master_, bytes.data(), bytes.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
  }
  [[nodiscard]] bool has_host() override {
    pollfd asked{master_, POLLIN, 0};
    return master_ >= 0 && ::poll(&asked, 1, 0) >= 0 && (asked.revents & POLLHUP) == 0;
  }
  [[nodiscard]] int host_baud(int device) override {
    termios settings{};
    if (tcgetattr(master_, &settings) != 0) {
      return device;
    }
    const speed_t code = cfgetospeed(&settings);
    const auto* const speed = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                           [code](const Speed& s) { return s.code == code; });
    return speed != kSpeeds.end() ? speed->baud : device;
  }
  void unplug() override {
    if (master_ >= 0) {
      std::error_code error;
      fs::remove(name_, error);
      ::close(std::exchange(master_, -1));
    }
  }
  void plug() override {
    if (master_ >= 0) {
      return;
    }
    master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    std::array<char, 64> slave{};
    if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0 ||
        ptsname_r(master_, slave.data(), slave.size()) != 0 || !make_raw(slave.data())) {
      unplug();
      return;
    }
    std::error_code error;
    fs::create_directories(name_.parent_path(), error);
    if (fs::is_symlink(fs::symlink_status(name_, error))) {
      fs::remove(name_, error);  // of a bench that was killed; anything else stays
    }
    fs::create_symlink(slave.data(), name_, error);
    if (error) {
      unplug();
    }
  }

 private:
  // Else what is sent before the boat opens it comes back as an echo.
  [[nodiscard]] static bool make_raw(const char* slave) {
    const int opened = ::open(slave, O_RDWR | O_NOCTTY | O_CLOEXEC);
    termios settings{};
    if (opened < 0) {
      return false;
    }
    bool done = tcgetattr(opened, &settings) == 0;
    cfmakeraw(&settings);
    done = done && tcsetattr(opened, TCSANOW, &settings) == 0;
    return ::close(opened) == 0 && done;
  }

  fs::path name_;
  int master_ = -1;
};

class CableLine final : public HostLine {
 public:
  CableLine(std::string path, int baud, PortOpener open)
      : path_{std::move(path)}, baud_{baud}, open_{std::move(open)} {
    plug();
    if (!port_) {
      throw StartupError(path_ + ": " + describe(fault_));
    }
  }

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) override {
    return port_ ? port_->read(into) : 0;
  }
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes) override {
    return port_ ? port_->write(bytes) : 0;
  }
  [[nodiscard]] bool has_host() override { return port_ != nullptr; }
  // A device that was told another speed speaks at that.
  [[nodiscard]] int host_baud(int device) override {
    if (device != 0 && device != baud_) {
      baud_ = device;
      port_.reset();
      plug();
    }
    return device;
  }
  void unplug() override { port_.reset(); }
  void plug() override {
    if (!port_) {
      OpenedPort opened = open_(path_, baud_);
      port_ = std::move(opened.port);
      fault_ = opened.fault;
    }
  }

 private:
  std::string path_;
  int baud_;
  PortOpener open_;
  std::unique_ptr<Port> port_;
  DeviceFault fault_ = DeviceFault::kNone;
};

}  // namespace

std::unique_ptr<HostLine> make_pty_line(const fs::path& name) {
  return std::make_unique<PtyLine>(name);
}

std::unique_ptr<HostLine> make_cable_line(const std::string& path, int baud, PortOpener open) {
  return std::make_unique<CableLine>(path, baud, std::move(open));
}

void DevicePort::pump(Time now) {
  wire_.advance(now);
  if (wire_.plugged() != plugged_) {
    plugged_ = wire_.plugged();
    held_.clear();
    plugged_ ? line_->plug() : line_->unplug();
  }
  const int host_baud = line_->host_baud(device_.baud());
  std::array<std::uint8_t, 256> bytes{};
  for (std::size_t count = line_->read(bytes); count > 0; count = line_->read(bytes)) {
    for (std::size_t i = 0; i < count; ++i) {
      wire_.from_host(bytes[i], now, host_baud, device_.baud());
    }
  }
  to_host_.clear();
  exchange(device_, wire_, host_baud, now, to_host_);
  if (!line_->has_host()) {
    held_.clear();
    return;
  }
  held_.insert(held_.end(), to_host_.begin(), to_host_.end());
  std::size_t due = 0;
  while (due < bytes.size() && due < held_.size() && held_[due].at <= now) {
    bytes[due] = held_[due].value;
    ++due;
  }
  const std::size_t taken = due > 0 ? line_->write(std::span{bytes}.first(due)) : 0;
  const std::size_t lost = held_.size() - taken > kMaxHeld ? held_.size() - taken - kMaxHeld : 0;
  held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(taken + lost));
}

}  // namespace lodesman
