// SPDX-License-Identifier: Apache-2.0
// What every terminal device needs before it can be a port: to be found, held by nobody else, raw,
// and without bytes of the past. Helper threads alone; all of this may block.
#pragma once

#include <sys/types.h>

#include <string>

#include "drivers/stream/file_descriptor.h"
#include "mid_level/messages/health.h"

namespace lodesman {

// A terminal device that is open (without becoming anybody's controlling terminal) and locked: by
// flock, so that of programs that ask for the lock, this one included, one alone has it.
struct TtyClaim {
  FileDescriptor descriptor;  // not open where there is a fault; holds the lock
  std::string node;           // of the device itself: no link
  dev_t device = 0;
  DeviceFault fault = DeviceFault::kNone;
};

// Links are followed anew at each call. Nothing of the device is changed, so that whoever holds it
// is not disturbed.
[[nodiscard]] TtyClaim claim_tty(const std::string& path);

// What an errno of opening says of a port.
[[nodiscard]] DeviceFault fault_of_open(int error) noexcept;

// The far end of a pty, by its device number: it has no modem lines, which libserialport insists
// on.
[[nodiscard]] bool is_pty(dev_t device) noexcept;
// Some real ports have none either: a gadget's, for one.
[[nodiscard]] bool has_modem_lines(int descriptor) noexcept;

// 8 data bits, no parity, one stop bit; no flow control, echo or meaning in any byte; the modem
// lines stay as they are when it is closed, for some boards reset themselves when they fall.
// False where the device does not take it.
[[nodiscard]] bool set_raw(int descriptor) noexcept;

// False where there is no such speed [bit/s], or the device does not take it.
[[nodiscard]] bool set_speed(int descriptor, int baud) noexcept;

// Drops what waits to be read, and what the kernel has still to make ready: a pty keeps 18 KiB.
void discard_input(int descriptor) noexcept;
// Drops what waits to be sent: closing would wait for it to leave, on some devices 30 s.
void discard_output(int descriptor) noexcept;

// The device has hung up, or was never there.
[[nodiscard]] bool has_hung_up(int descriptor) noexcept;

}  // namespace lodesman
