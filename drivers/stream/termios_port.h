// SPDX-License-Identifier: Apache-2.0
// A port by system calls alone: a pty, or a real port without modem lines, neither of which
// libserialport opens. Threads as port.h says.
#pragma once

#include "drivers/stream/port.h"
#include "drivers/stream/tty.h"

namespace lodesman {

class TermiosPort final : public Port {
 public:
  // May block. Refuses a speed that it cannot have with kDoesNotFit.
  //
  // TIOCEXCL is not asked for: on a pty it outlives its holder for as long as the other end is
  // open, and a boat that was killed could not open its port again. The claim's lock does.
  [[nodiscard]] static OpenedPort open(TtyClaim claim, int baud);

  explicit TermiosPort(FileDescriptor descriptor) noexcept : descriptor_{std::move(descriptor)} {}
  TermiosPort(const TermiosPort&) = delete;
  TermiosPort& operator=(const TermiosPort&) = delete;
  ~TermiosPort() override;

  [[nodiscard]] std::size_t read(std::span<std::uint8_t> into) noexcept override;
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes) noexcept override;
  [[nodiscard]] bool is_gone() const noexcept override;
  [[nodiscard]] int descriptor() const noexcept override { return descriptor_.value(); }

 private:
  FileDescriptor descriptor_;
};

}  // namespace lodesman
