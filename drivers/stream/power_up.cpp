// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/power_up.h"

#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <fstream>
#include <string>
#include <system_error>

#include "drivers/stream/tty.h"

namespace lodesman {
namespace {

namespace fs = std::filesystem;

// Pololu's: a Maestro is its own USB device, whose processor starts anew with each enumeration.
constexpr const char* kOwnUsbVendor = "1ffb";
constexpr int kParents_max = 8;

[[nodiscard]] std::string line_of(const fs::path& file) {
  std::string line;
  std::ifstream stream{file};
  std::getline(stream, line);
  return line;
}

// The USB device that a terminal belongs to; empty where it belongs to none.
[[nodiscard]] fs::path usb_device_of(dev_t device, const fs::path& sysfs) {
  std::error_code error;
  const std::string number = std::to_string(major(device)) + ":" + std::to_string(minor(device));
  fs::path place = fs::canonical(sysfs / "dev" / "char" / number / "device", error);
  for (int i = 0; !error && i < kParents_max && place.has_relative_path(); ++i) {
    if (fs::exists(place / "idVendor", error)) {
      return place;
    }
    place = place.parent_path();
  }
  return {};
}

// Fowler, Noll and Vo's hash 1a of 64 bits.
[[nodiscard]] std::uint64_t hash_of(const std::string& text) noexcept {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  }
  return hash != 0 ? hash : 1;
}

}  // namespace

std::uint64_t power_up_of(int descriptor, const PowerUpSources& sources) {
  struct stat node {};
  const std::string boot = line_of(sources.boot_id);
  if (boot.empty() || fstat(descriptor, &node) != 0) {
    return 0;
  }
  std::string text = boot + '\n' + std::to_string(node.st_rdev) + '\n' +
                     std::to_string(node.st_ino) + '\n' + std::to_string(node.st_ctim.tv_sec) +
                     '.' + std::to_string(node.st_ctim.tv_nsec) + '\n';
  const fs::path usb = usb_device_of(node.st_rdev, sources.sysfs);
  if (usb.empty()) {
    return is_pty(node.st_rdev) ? hash_of(text) : 0;
  }
  const std::string number = line_of(usb / "devnum");
  if (line_of(usb / "idVendor") != kOwnUsbVendor || number.empty()) {
    return 0;
  }
  for (const char* name : {"idProduct", "busnum", "serial"}) {
    text += line_of(usb / name) + '\n';
  }
  return hash_of(text + number);
}

}  // namespace lodesman
