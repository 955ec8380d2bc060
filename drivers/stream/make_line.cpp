// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/make_line.h"

#include <utility>

#include "drivers/stream/power_up.h"
#include "drivers/stream/reconnecting_line.h"
#include "drivers/stream/serial_port.h"
#include "drivers/stream/tcp_port.h"
#include "drivers/stream/termios_port.h"
#include "drivers/stream/tty.h"

namespace lodesman {

OpenedPort open_port(const std::string& path, int baud) {
  TtyClaim claim = claim_tty(path);
  if (claim.fault != DeviceFault::kNone) {
    return {nullptr, claim.fault};
  }
  const bool plain = is_pty(claim.device) || !has_modem_lines(claim.descriptor.value()) ||
                     !SerialPort::knows(claim.node);
  const std::uint64_t power_up = power_up_of(claim.descriptor.value());
  OpenedPort opened =
      plain ? TermiosPort::open(std::move(claim), baud) : SerialPort::open(std::move(claim), baud);
  opened.power_up = power_up;
  return opened;
}

std::unique_ptr<ByteStream> make_line(const std::string& path, int baud,
                                      std::function<void()> on_bytes) {
  return std::make_unique<ReconnectingLine>(path, baud, open_port, std::move(on_bytes));
}

std::unique_ptr<ByteStream> make_tcp_line(const std::string& place,
                                          std::function<void()> on_bytes) {
  constexpr int kNoSpeed = 0;
  return std::make_unique<ReconnectingLine>(
      place, kNoSpeed, [](const std::string& where, int /*baud*/) { return TcpPort::open(where); },
      std::move(on_bytes));
}

}  // namespace lodesman
