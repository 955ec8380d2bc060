// SPDX-License-Identifier: Apache-2.0
// Asks a Maestro for its parameters over USB, by libusb. Only the control endpoint is spoken to, so
// that the kernel's driver keeps the serial ports; nothing is written. Each question waits for half
// a second at most. One thread.
#pragma once

#include <string>

#include "deploy/operator/doctor/maestro_settings.h"

namespace lodesman::cli {

struct MaestroAnswer {
  enum class Outcome : std::uint8_t {
    kRead,
    kForbidden,  // this user may not open the device
    kSilent,     // it cannot be opened, or does not answer
  };
  Outcome outcome = Outcome::kSilent;
  MaestroSettings settings;  // where it was read
};

// node: /dev/bus/usb/001/004.
[[nodiscard]] MaestroAnswer ask_maestro(const std::string& node, const MaestroOptions& options);

}  // namespace lodesman::cli
