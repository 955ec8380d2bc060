// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/maestro_usb.h"

#include <fcntl.h>
#include <libusb.h>
#include <unistd.h>

#include <cerrno>

namespace lodesman::cli {
namespace {

// The device is the recipient, and the request its maker's.
constexpr std::uint8_t kFromDevice = 0xC0;
constexpr std::uint8_t kGetParameter = 0x81;
constexpr unsigned kWait_ms = 500;

// Opened by its node, so that no other device is looked at.
class UsbDevice {
 public:
  explicit UsbDevice(const std::string& node) : file_{open(node.c_str(), O_RDWR | O_CLOEXEC)} {
    if (file_ < 0) {
      forbidden_ = errno == EACCES || errno == EPERM;
      return;
    }
    static_cast<void>(libusb_set_option(nullptr, LIBUSB_OPTION_NO_DEVICE_DISCOVERY));
    if (libusb_init(&context_) != LIBUSB_SUCCESS) {
      context_ = nullptr;
    } else if (libusb_wrap_sys_device(context_, file_, &handle_) != LIBUSB_SUCCESS) {
      handle_ = nullptr;
    }
  }
  UsbDevice(const UsbDevice&) = delete;
  UsbDevice& operator=(const UsbDevice&) = delete;
  ~UsbDevice() {
    if (handle_ != nullptr) {
      libusb_close(handle_);
    }
    if (context_ != nullptr) {
      libusb_exit(context_);
    }
    if (file_ >= 0) {
      close(file_);
    }
  }

  [[nodiscard]] bool forbidden() const noexcept { return forbidden_; }
  [[nodiscard]] bool opened() const noexcept { return handle_ != nullptr; }
  [[nodiscard]] bool parameter(std::uint8_t index, std::span<std::uint8_t> bytes) const noexcept {
    const auto size = static_cast<std::uint16_t>(bytes.size());
    return libusb_control_transfer(handle_, kFromDevice, kGetParameter, 0, index, bytes.data(),
                                   size, kWait_ms) == size;
  }

 private:
  int file_;
  bool forbidden_ = false;
  libusb_context* context_ = nullptr;
  libusb_device_handle* handle_ = nullptr;
};

}  // namespace

MaestroAnswer ask_maestro(const std::string& node, const MaestroOptions& options) {
  const UsbDevice device{node};
  if (!device.opened()) {
    return {
        device.forbidden() ? MaestroAnswer::Outcome::kForbidden : MaestroAnswer::Outcome::kSilent,
        {}};
  }
  const auto settings =
      read_maestro([&](std::uint8_t index,
                       std::span<std::uint8_t> bytes) { return device.parameter(index, bytes); },
                   options);
  return settings ? MaestroAnswer{MaestroAnswer::Outcome::kRead, *settings} : MaestroAnswer{};
}

}  // namespace lodesman::cli
