// SPDX-License-Identifier: Apache-2.0
// The real libusb, and in the kernel's place a file that begins with a device's descriptors: what
// reaches the device, and what becomes of its answers.
#include "deploy/operator/doctor/maestro_usb.h"

#include <fcntl.h>
#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdarg>
#include <cstring>
#include <fstream>
#include <map>

#include "tests/support/catch.h"
#include "tests/unit/report/temporary_directory.h"

namespace lodesman::testing {
namespace {

using namespace cli;
using Outcome = MaestroAnswer::Outcome;

struct Setup {
  std::uint8_t request_type = 0;
  std::uint8_t request = 0;
  std::uint16_t value = 0;
  std::uint16_t index = 0;
  std::uint16_t length = 0;

  friend bool operator==(const Setup&, const Setup&) = default;
};

// What stands in for usbfs, for the one file that it knows.
struct Usbfs {
  ino_t file = 0;
  bool answers = true;
  std::map<unsigned, std::uint8_t> memory;  // of the device, by parameter, byte by byte
  std::vector<Setup> asked;
  usbdevfs_urb* done = nullptr;

  [[nodiscard]] bool knows(int descriptor) const {
    struct stat status {};
    return file != 0 && syscall(SYS_fstat, descriptor, &status) == 0 && status.st_ino == file;
  }
  void submit(usbdevfs_urb* urb) {
    const auto* bytes = static_cast<const std::uint8_t*>(urb->buffer);
    const auto word = [&](std::size_t at) {
      return static_cast<std::uint16_t>(bytes[at] | bytes[at + 1] << 8);
    };
    const Setup setup{bytes[0], bytes[1], word(2), word(4), word(6)};
    asked.push_back(setup);
    urb->status = answers ? 0 : -EPIPE;
    urb->actual_length = answers ? setup.length : 0;
    for (unsigned i = 0; answers && i < setup.length; ++i) {
      static_cast<std::uint8_t*>(urb->buffer)[8 + i] = memory[setup.index + i];
    }
    done = urb;
  }
  [[nodiscard]] int call(unsigned long request, void* argument) {
    switch (request) {
      case USBDEVFS_CONNECTINFO: *static_cast<usbdevfs_connectinfo*>(argument) = {7, 0}; return 0;
      case USBDEVFS_GET_CAPABILITIES: *static_cast<__u32*>(argument) = 0; return 0;
      case USBDEVFS_SUBMITURB: submit(static_cast<usbdevfs_urb*>(argument)); return 0;
      case USBDEVFS_REAPURBNDELAY:
        if (done != nullptr) {
          *static_cast<usbdevfs_urb**>(argument) = std::exchange(done, nullptr);
          return 0;
        }
        errno = EAGAIN;
        return -1;
      default: errno = ENOTTY; return -1;
    }
  }
};

Usbfs& usbfs() {
  static Usbfs stand_in;
  return stand_in;
}

// Device, one configuration, one interface without endpoints.
constexpr std::array<std::uint8_t, 18 + 9 + 9> kDescriptors{
    18, 1, 0x00, 0x02, 0, 0,    0, 8,    0xFB, 0x1F, 0x8A, 0x00, 0x01, 0x01, 1, 2, 5, 1,  //
    9,  2, 18,   0,    1, 1,    0, 0xC0, 50,                                              //
    9,  4, 0,    0,    0, 0xFF, 0, 0,    0};

class UsbBench {
 public:
  UsbBench() {
    std::ofstream{node(), std::ios::binary}.write(
        reinterpret_cast<const char*>(kDescriptors.data()), kDescriptors.size());
    struct stat status {};
    REQUIRE(stat(node().c_str(), &status) == 0);
    usbfs() = {};
    usbfs().file = status.st_ino;
  }
  UsbBench(const UsbBench&) = delete;
  UsbBench& operator=(const UsbBench&) = delete;
  ~UsbBench() { usbfs() = {}; }
  [[nodiscard]] std::string node() const { return (directory_.path() / "007").string(); }

 private:
  TemporaryDirectory directory_;
};

TEST_CASE("maestro usb: each question is a read of the maker's, and its answer is taken", "[cli]") {
  const UsbBench bench;
  usbfs().memory = {{6, 0x2C}, {7, 0x01}, {9, 1}, {39, 0x70}, {40, 0x17}, {41, 62}, {42, 125}};
  MaestroOptions options;
  options.left_channel = 1;
  options.right_channel = 0;
  const MaestroAnswer answer = ask_maestro(bench.node(), options);
  REQUIRE(answer.outcome == Outcome::kRead);
  CHECK(answer.settings.time_out == std::chrono::seconds{3});
  CHECK(answer.settings.never_suspend);
  CHECK(answer.settings.left.home_quarter_us == 6000);
  CHECK(answer.settings.left.least_quarter_us == 3968);
  CHECK(answer.settings.left.most_quarter_us == 8000);
  CHECK(answer.settings.right.home_quarter_us == MaestroChannel::kHomeOff);
  REQUIRE(usbfs().asked.size() == 14);
  CHECK(usbfs().asked[0] == Setup{0xC0, 0x81, 0, 3, 1});
  CHECK(usbfs().asked[1] == Setup{0xC0, 0x81, 0, 6, 2});
  CHECK(usbfs().asked[4] == Setup{0xC0, 0x81, 0, 39, 2});
  for (const Setup& setup : usbfs().asked) {
    CHECK(setup.request_type == 0xC0);  // nothing is written
    CHECK(setup.request == 0x81);
  }
}

TEST_CASE("maestro usb: a device that refuses the question is silent", "[cli]") {
  const UsbBench bench;
  usbfs().answers = false;
  CHECK(ask_maestro(bench.node(), {}).outcome == Outcome::kSilent);
  CHECK(usbfs().asked.size() == 1);
}

TEST_CASE("maestro usb: what is no USB device, or is not there, is silent", "[cli]") {
  CHECK(ask_maestro("/dev/null", {}).outcome == Outcome::kSilent);
  CHECK(ask_maestro("/dev/bus/usb/999/999", {}).outcome == Outcome::kSilent);
}

TEST_CASE("maestro usb: a node that this user may not open is forbidden", "[cli]") {
  const UsbBench bench;
  REQUIRE(chmod(bench.node().c_str(), 0400) == 0);
  const bool is_bound = access(bench.node().c_str(), W_OK) != 0;  // root is bound by nothing
  CHECK(ask_maestro(bench.node(), {}).outcome == (is_bound ? Outcome::kForbidden : Outcome::kRead));
}

}  // namespace

// For ioctl, below.
bool stand_in_knows(int descriptor) { return usbfs().knows(descriptor); }
int stand_in_call(unsigned long request, void* argument) { return usbfs().call(request, argument); }

}  // namespace lodesman::testing

// The linker takes it for libusb too. What is not for the stand-in goes to the system.
extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
  std::va_list rest;
  va_start(rest, request);
  void* argument = va_arg(rest, void*);
  va_end(rest);
  if (lodesman::testing::stand_in_knows(descriptor)) {
    return lodesman::testing::stand_in_call(request, argument);
  }
  return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
}
