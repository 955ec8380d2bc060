// SPDX-License-Identifier: Apache-2.0
// A port for programs that are about to be started. Blocks for a moment; any thread.
#pragma once

#include <cstdint>

namespace lodesman {

// A UDP port of this computer that nobody has; another program may take it before ours does. Throws
// StartupError where there is none.
[[nodiscard]] std::uint16_t free_udp_port();

}  // namespace lodesman
