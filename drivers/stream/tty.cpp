// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/tty.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>

namespace lodesman {
namespace {

// <linux/major.h>: UNIX98_PTY_SLAVE_MAJOR and the seven after it.
constexpr unsigned kPtyMajorFirst = 136;
constexpr unsigned kPtyMajorLast = 143;

struct Speed {
  int baud;
  speed_t code;
};
constexpr std::array kSpeeds{
    Speed{1200, B1200},     Speed{2400, B2400},     Speed{4800, B4800},     Speed{9600, B9600},
    Speed{19200, B19200},   Speed{38400, B38400},   Speed{57600, B57600},   Speed{115200, B115200},
    Speed{230400, B230400}, Speed{460800, B460800}, Speed{921600, B921600},
};

constexpr tcflag_t kFlowControl = IXON | IXOFF | IXANY;

[[nodiscard]] TtyClaim refused(DeviceFault fault) { return {{}, {}, 0, fault}; }

}  // namespace

DeviceFault fault_of_open(int error) noexcept {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
    case ELOOP:
    case ENXIO:
    case ENODEV:
    case EIO: return DeviceFault::kNoPort;
    case EBUSY:
    case EWOULDBLOCK: return DeviceFault::kPortBusy;
    case EACCES:
    case EPERM: return DeviceFault::kNoPermission;
    default: return DeviceFault::kNotAPort;
  }
}

TtyClaim claim_tty(const std::string& path) {
  std::array<char, PATH_MAX> resolved{};
  if (realpath(path.c_str(), resolved.data()) == nullptr) {
    return refused(fault_of_open(errno));
  }
  // Before it is opened: that alone would do something to a pipe.
  struct stat status {};
  if (stat(resolved.data(), &status) != 0) {
    return refused(fault_of_open(errno));
  }
  if (!S_ISCHR(status.st_mode)) {
    return refused(DeviceFault::kNotAPort);
  }
  FileDescriptor descriptor{open(resolved.data(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  if (!descriptor.is_open()) {
    return refused(fault_of_open(errno));
  }
  termios settings{};
  if (tcgetattr(descriptor.value(), &settings) != 0) {
    return refused(errno == ENOTTY ? DeviceFault::kNotAPort : fault_of_open(errno));
  }
  if (flock(descriptor.value(), LOCK_EX | LOCK_NB) != 0) {
    return refused(fault_of_open(errno));
  }
  return {std::move(descriptor), resolved.data(), status.st_rdev, DeviceFault::kNone};
}

bool is_pty(dev_t device) noexcept {
  return major(device) >= kPtyMajorFirst && major(device) <= kPtyMajorLast;
}

bool has_modem_lines(int descriptor) noexcept {
  int lines = 0;
  return ioctl(descriptor, TIOCMGET, &lines) == 0;
}

bool set_raw(int descriptor) noexcept {
  termios settings{};
  if (tcgetattr(descriptor, &settings) != 0) {
    return false;
  }
  cfmakeraw(&settings);
  settings.c_iflag &= ~(kFlowControl | INPCK);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS | HUPCL);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (tcsetattr(descriptor, TCSANOW, &settings) != 0 || tcgetattr(descriptor, &settings) != 0) {
    return false;
  }
  // It answers well where it has done some of what it was told.
  return (settings.c_iflag & kFlowControl) == 0 && (settings.c_cflag & CRTSCTS) == 0 &&
         (settings.c_lflag & (ICANON | ECHO | ISIG)) == 0 && (settings.c_oflag & OPOST) == 0;
}

bool set_speed(int descriptor, int baud) noexcept {
  const auto* speed = std::find_if(kSpeeds.begin(), kSpeeds.end(),
                                   [&](const Speed& one) { return one.baud == baud; });
  termios settings{};
  return speed != kSpeeds.end() && tcgetattr(descriptor, &settings) == 0 &&
         cfsetspeed(&settings, speed->code) == 0 &&
         tcsetattr(descriptor, TCSANOW, &settings) == 0 && tcgetattr(descriptor, &settings) == 0 &&
         cfgetospeed(&settings) == speed->code;
}

void discard_input(int descriptor) noexcept { tcflush(descriptor, TCIFLUSH); }

void discard_output(int descriptor) noexcept { tcflush(descriptor, TCOFLUSH); }

bool has_hung_up(int descriptor) noexcept {
  int waiting = 0;
  return ioctl(descriptor, FIONREAD, &waiting) != 0;
}

}  // namespace lodesman
