// SPDX-License-Identifier: Apache-2.0
// The linker takes these for every library of the program too. What is not theirs goes to the
// system by its number.
#include "tests/conformance/interposed.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/sysmacros.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdarg>
#include <ctime>
#include <string_view>

namespace lodesman::testing {
namespace {

std::atomic<std::uint64_t> g_modem_lines_asked{0};
std::atomic<std::int64_t> g_wall_clock_ahead_s{0};

constexpr std::string_view kListOfPtys = "/sys/class/tty/pts/";
constexpr std::string_view kWhereTheyLead = "../../devices/virtual/tty/pts";

[[nodiscard]] bool is_listed_pty(const char* path) {
  return std::string_view{path}.starts_with(kListOfPtys);
}

[[nodiscard]] bool is_pty_slave(int descriptor) {
  struct stat status {};
  return syscall(SYS_fstat, descriptor, &status) == 0 && S_ISCHR(status.st_mode) &&
         major(status.st_rdev) == 136;
}

[[nodiscard]] int stat_of_link(const char* path, struct stat* status) {
  if (is_listed_pty(path)) {
    *status = {};
    status->st_mode = S_IFLNK | 0777;
    return 0;
  }
  return static_cast<int>(syscall(SYS_lstat, path, status));
}

}  // namespace

std::uint64_t modem_lines_asked() noexcept { return g_modem_lines_asked; }

void set_wall_clock_ahead(std::chrono::seconds offset) noexcept {
  g_wall_clock_ahead_s = offset.count();
}

}  // namespace lodesman::testing

extern "C" {

int ioctl(int descriptor, unsigned long request, ...) noexcept {
  std::va_list rest;
  va_start(rest, request);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  const bool of_lines =
      request == TIOCMGET || request == TIOCMSET || request == TIOCMBIS || request == TIOCMBIC;
  if (of_lines && lodesman::testing::is_pty_slave(descriptor)) {
    if (request == TIOCMGET) {
      *static_cast<int*>(argument) = TIOCM_DTR | TIOCM_RTS;
    }
    ++lodesman::testing::g_modem_lines_asked;
    return 0;
  }
  return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
}

int lstat(const char* path, struct stat* status) noexcept {
  return lodesman::testing::stat_of_link(path, status);
}

// What libraries call lstat that were built with an older C library.
int __lxstat(int /*version*/, const char* path, struct stat* status) noexcept {  // NOLINT
  return lodesman::testing::stat_of_link(path, status);
}

ssize_t readlink(const char* path, char* into, std::size_t size) noexcept {
  if (lodesman::testing::is_listed_pty(path)) {
    const std::string_view to = lodesman::testing::kWhereTheyLead;
    const std::size_t count = std::min(size, to.size());
    std::copy_n(to.begin(), count, into);
    return static_cast<ssize_t>(count);
  }
  return syscall(SYS_readlink, path, into, size);
}

int clock_gettime(clockid_t clock, timespec* time) noexcept {
  const auto result = static_cast<int>(syscall(SYS_clock_gettime, clock, time));
  if (clock == CLOCK_REALTIME) {
    time->tv_sec += lodesman::testing::g_wall_clock_ahead_s;
  }
  return result;
}

int gettimeofday(timeval* time, void* /*zone*/) noexcept {
  timespec now{};
  const int result = clock_gettime(CLOCK_REALTIME, &now);
  *time = {now.tv_sec, now.tv_nsec / 1000};
  return result;
}

}  // extern "C"
