// SPDX-License-Identifier: Apache-2.0
// A connection to a server by TCP, which serves as a port does. Threads as port.h says: the helper
// looks its name up, which takes as long as the system's resolver does, and connects within
// kConnectLimit; the task reads and writes without waiting.
#pragma once

#include "drivers/stream/file_descriptor.h"
#include "drivers/stream/port.h"

namespace lodesman {

class TcpPort final : public Port {
 public:
  static constexpr int kConnectLimit_ms = 2000;

  // place: "host:port", "1.2.3.4:port" or "[1::2]:port". Of several addresses the first one that
  // answers. kNoService where none does, or there is no such host.
  [[nodiscard]] static OpenedPort open(const std::string& place);

  explicit TcpPort(FileDescriptor descriptor) noexcept : descriptor_{std::move(descriptor)} {}

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override;
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes) noexcept override;
  // By the other end's own word. One that vanished without a word looks connected.
  [[nodiscard]] bool is_gone() const noexcept override;
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_.value(); }

 private:
  FileDescriptor descriptor_;
};

}  // namespace lodesman
