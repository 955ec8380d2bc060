// SPDX-License-Identifier: Apache-2.0
// Makes the line to a real port, whichever kind of port it turns out to be. At start-up, by the
// thread that makes the devices.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "drivers/stream/byte_stream.h"
#include "drivers/stream/port.h"

namespace lodesman {

// Opens what the path leads to by now: a pty and a port without modem lines by system calls, any
// other through libserialport. May block.
[[nodiscard]] OpenedPort open_port(const std::string& path, int baud);

// path: a device or a link to one, which need not be there. baud: [bit/s]. on_bytes: see
// reconnecting_line.h. Throws StartupError where the system has no thread or descriptor left.
[[nodiscard]] std::unique_ptr<ByteStream> make_line(const std::string& path, int baud,
                                                    std::function<void()> on_bytes = {});

// The same to a server by TCP; place: "host:port".
[[nodiscard]] std::unique_ptr<ByteStream> make_tcp_line(const std::string& place,
                                                        std::function<void()> on_bytes = {});

}  // namespace lodesman
