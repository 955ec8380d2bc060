// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/termios_port.h"

#include <unistd.h>

namespace lodesman {
OpenedPort TermiosPort::open(TtyClaim claim, int baud) {
  const int descriptor = claim.descriptor.value();
  if (!set_raw(descriptor) || !set_speed(descriptor, baud)) {
    return {nullptr, has_hung_up(descriptor) ? DeviceFault::kNoPort : DeviceFault::kDoesNotFit};
  }
  discard_input(descriptor);
  return {std::make_unique<TermiosPort>(std::move(claim.descriptor)), DeviceFault::kNone};
}

TermiosPort::~TermiosPort() { discard_output(descriptor_.value()); }

std::size_t TermiosPort::read(std::span<std::uint8_t> into) noexcept {
  return count_of(::read(descriptor_.value(), into.data(), into.size()));
}

std::size_t TermiosPort::write(std::span<const std::uint8_t> bytes) noexcept {
  return count_of(::write(descriptor_.value(), bytes.data(), bytes.size()));
}

bool TermiosPort::is_gone() const noexcept { return has_hung_up(descriptor_.value()); }

}  // namespace lodesman
