// SPDX-License-Identifier: Apache-2.0
// A serial port with modem lines, through libserialport. Threads as port.h says; of the library the
// task's side calls what was seen not to block or allocate, and nothing that waits, for that goes
// by the wall clock in version 0.1.1.
#pragma once

#include "drivers/stream/port.h"
#include "drivers/stream/tty.h"

struct sp_port;

namespace lodesman {

class SerialPort final : public Port {
 public:
  // May block. The claim is held for as long as the port: the library has a descriptor of its own.
  [[nodiscard]] static OpenedPort open(TtyClaim claim, int baud);
  // Whether the library knows the device: only those that the kernel lists as terminals.
  [[nodiscard]] static bool knows(const std::string& node) noexcept;

  SerialPort(TtyClaim claim, sp_port* port, int descriptor) noexcept;
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;
  ~SerialPort() override;

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override;
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] bool is_gone() const noexcept override;
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_; }

 private:
  struct Deleter {
    void operator()(sp_port* port) const noexcept;
  };
  TtyClaim claim_;
  std::unique_ptr<sp_port, Deleter> port_;
  int descriptor_;
};

}  // namespace lodesman
