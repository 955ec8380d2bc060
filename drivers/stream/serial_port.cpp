// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/serial_port.h"

#include <fcntl.h>
#include <libserialport.h>
#include <sys/ioctl.h>

namespace lodesman {
namespace {

// Asked by root too, whom the kernel lets in all the same.
[[nodiscard]] bool is_held_exclusively(int descriptor) noexcept {
  int exclusive = 0;
  return ioctl(descriptor, TIOCGEXCL, &exclusive) == 0 && exclusive != 0;
}

[[nodiscard]] DeviceFault fault_of(sp_return result) noexcept {
  return result == SP_ERR_FAIL ? fault_of_open(sp_last_error_code()) : DeviceFault::kNotAPort;
}

// After sp_open, version 0.1.1 has left IXON, IXANY and HUPCL on, and a descriptor that programs
// started later would inherit.
[[nodiscard]] bool configure(sp_port* port, int descriptor, int baud) noexcept {
  return fcntl(descriptor, F_SETFD, FD_CLOEXEC) == 0 && ioctl(descriptor, TIOCEXCL) == 0 &&
         sp_set_baudrate(port, baud) == SP_OK && sp_set_bits(port, 8) == SP_OK &&
         sp_set_parity(port, SP_PARITY_NONE) == SP_OK && sp_set_stopbits(port, 1) == SP_OK &&
         sp_set_flowcontrol(port, SP_FLOWCONTROL_NONE) == SP_OK && set_raw(descriptor);
}

}  // namespace

void SerialPort::Deleter::operator()(sp_port* port) const noexcept {
  sp_close(port);
  sp_free_port(port);
}

bool SerialPort::knows(const std::string& node) noexcept {
  sp_port* port = nullptr;
  const bool known = sp_get_port_by_name(node.c_str(), &port) == SP_OK;
  sp_free_port(port);
  return known;
}

OpenedPort SerialPort::open(TtyClaim claim, int baud) {
  if (is_held_exclusively(claim.descriptor.value())) {
    return {nullptr, DeviceFault::kPortBusy};
  }
  sp_port* named = nullptr;
  if (const sp_return found = sp_get_port_by_name(claim.node.c_str(), &named); found != SP_OK) {
    return {nullptr, fault_of(found)};
  }
  if (const sp_return opened = sp_open(named, SP_MODE_READ_WRITE); opened != SP_OK) {
    const DeviceFault fault = fault_of(opened);
    sp_free_port(named);
    return {nullptr, fault};
  }
  int descriptor = -1;
  const bool has_handle = sp_get_port_handle(named, &descriptor) == SP_OK;
  auto port = std::make_unique<SerialPort>(std::move(claim), named, descriptor);
  if (!has_handle || !configure(named, descriptor, baud)) {
    return {nullptr, port->is_gone() ? DeviceFault::kNoPort : DeviceFault::kDoesNotFit};
  }
  discard_input(descriptor);
  return {std::move(port), DeviceFault::kNone};
}

SerialPort::SerialPort(TtyClaim claim, sp_port* port, int descriptor) noexcept
    : claim_{std::move(claim)}, port_{port}, descriptor_{descriptor} {}

SerialPort::~SerialPort() {
  discard_output(descriptor_);
  ioctl(descriptor_, TIOCNXCL);
}

std::size_t SerialPort::read(std::span<std::uint8_t> into) noexcept {
  const int count = sp_nonblocking_read(port_.get(), into.data(), into.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

std::size_t SerialPort::write(std::span<const std::uint8_t> bytes) noexcept {
  // Where it is full, 0.1.1 gives an error and 0.1.2 gives 0.
  const int count = sp_nonblocking_write(port_.get(), bytes.data(), bytes.size());
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool SerialPort::is_gone() const noexcept { return sp_input_waiting(port_.get()) < 0; }

}  // namespace lodesman
