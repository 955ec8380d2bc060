// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/power_up.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <chrono>
#include <fstream>
#include <string>
#include <thread>

#include "drivers/stream/file_descriptor.h"
#include "tests/support/catch.h"
#include "tests/support/pty_device.h"

using namespace lodesman;
using namespace lodesman::testing;
namespace fs = std::filesystem;

namespace {

[[nodiscard]] FileDescriptor opened(const std::string& path) {
  FileDescriptor descriptor{open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
  REQUIRE(descriptor.is_open());
  return descriptor;
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream{file} << text << '\n';
}

// A machine on which a pty's number is that of a USB device's terminal.
struct Machine {
  explicit Machine(const PtyDevice& pty) : descriptor{opened(pty.path())} {
    struct stat node {};
    REQUIRE(fstat(descriptor.value(), &node) == 0);
    const std::string number =
        std::to_string(major(node.st_rdev)) + ":" + std::to_string(minor(node.st_rdev));
    sources.sysfs = folder.path() / "sys";
    sources.boot_id = folder.path() / "boot_id";
    usb = sources.sysfs / "devices" / "usb1" / "1-2";
    fs::create_directories(usb / "1-2:1.0");
    fs::create_directories(sources.sysfs / "dev" / "char" / number);
    fs::create_directory_symlink(usb / "1-2:1.0",
                                 sources.sysfs / "dev" / "char" / number / "device");
    write(sources.boot_id, "31c1e5ae");
    write(usb / "idVendor", "1ffb");
    write(usb / "idProduct", "0089");
    write(usb / "busnum", "1");
    write(usb / "devnum", "5");
    write(usb / "serial", "00012345");
  }
  [[nodiscard]] std::uint64_t number() const { return power_up_of(descriptor.value(), sources); }

  TemporaryDirectory folder;
  FileDescriptor descriptor;
  PowerUpSources sources;
  fs::path usb;
};

}  // namespace

TEST_CASE("power-up: a pty is the same as long as it is there, and another one is another",
          "[drivers][stream]") {
  PtyDevice device;
  const std::uint64_t first = power_up_of(opened(device.path()).value());
  CHECK(first != 0);
  CHECK(power_up_of(opened(device.path()).value()) == first);
  device.unplug();
  std::this_thread::sleep_for(std::chrono::milliseconds{25});  // the kernel's tick: see power_up.h
  device.plug();
  CHECK(power_up_of(opened(device.path()).value()) != first);
}

TEST_CASE("power-up: of a box on the USB each enumeration, each boot and each box is another",
          "[drivers][stream]") {
  const PtyDevice pty;
  const Machine machine{pty};
  const std::uint64_t first = machine.number();
  CHECK(first != 0);
  CHECK(machine.number() == first);
  const auto changed = [&](const fs::path& file, const std::string& text) {
    std::string before;
    std::getline(std::ifstream{file}, before);
    write(file, text);
    const std::uint64_t number = machine.number();
    write(file, before);
    return number;
  };
  for (const auto& [file, text] :
       {std::pair{machine.usb / "devnum", "6"}, std::pair{machine.usb / "serial", "00012346"},
        std::pair{machine.usb / "busnum", "2"}, std::pair{machine.sources.boot_id, "77b0c3d4"}}) {
    const std::uint64_t other = changed(file, text);
    CHECK(other != 0);
    CHECK(other != first);
  }
  CHECK(machine.number() == first);
}

TEST_CASE("power-up: what may lose its power unseen is not known", "[drivers][stream]") {
  const PtyDevice pty;
  const Machine adapter{pty};
  write(adapter.usb / "idVendor", "0403");  // an FTDI cable: what is behind it has its own power
  CHECK(adapter.number() == 0);
  const Machine without_boot{pty};
  fs::remove(without_boot.sources.boot_id);
  CHECK(without_boot.number() == 0);
  CHECK(power_up_of(opened("/dev/null").value()) == 0);
  CHECK(power_up_of(-1) == 0);
}
