// SPDX-License-Identifier: Apache-2.0
// Stands between this test program, with all it links, and the system: a pty seems to be a serial
// port with modem lines that the kernel lists, so that libserialport opens it, and the wall clock
// may be set without touching the machine's. Any thread.
#pragma once

#include <chrono>
#include <cstdint>

namespace lodesman::testing {

// How often somebody asked a pty for its modem lines and was answered.
[[nodiscard]] std::uint64_t modem_lines_asked() noexcept;

// What CLOCK_REALTIME and gettimeofday are ahead of the machine's.
void set_wall_clock_ahead(std::chrono::seconds offset) noexcept;

}  // namespace lodesman::testing
