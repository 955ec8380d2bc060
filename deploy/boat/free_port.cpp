// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/free_port.h"

#include "drivers/stream/udp_socket.h"

namespace lodesman {

// Given by the system, and given back at once.
std::uint16_t free_udp_port() { return UdpSocket{{"127.0.0.1", 0, 0}}.local_port(); }

}  // namespace lodesman
