// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/receive_buffer.h"

#include <fmt/format.h>

#include "drivers/stream/udp_socket.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

// What the kernel tells is twice what it gives to bytes (socket(7), SO_RCVBUF).
constexpr int kToldPerGiven = 2;

}  // namespace

std::optional<ReceiveBufferFacts> measure_receive_buffer(const std::string& sonar) {
  if (!sonar.starts_with("delta_t:")) {
    return std::nullopt;
  }
  try {
    const UdpSocket trial{{"127.0.0.1", 0, 0}};
    return ReceiveBufferFacts{
        UdpSocket::kWantedBuffer_bytes,
        static_cast<std::uint64_t>(trial.receive_buffer_bytes() / kToldPerGiven)};
  } catch (const StartupError&) {
    return std::nullopt;
  }
}

Finding judge_receive_buffer(const ReceiveBufferFacts& facts) {
  const std::string what =
      fmt::format("{} KiB of a sonar's datagrams may wait here, {} KiB are asked for",
                  facts.granted_bytes / 1024, facts.wanted_bytes / 1024);
  if (facts.granted_bytes >= facts.wanted_bytes) {
    return {"sonar_buffer", Verdict::kOk, what, ""};
  }
  return {"sonar_buffer", Verdict::kWarn, what + ": on a busy machine pings are lost",
          fmt::format("echo net.core.rmem_max={} | sudo tee /etc/sysctl.d/60-lodesman.conf && "
                      "sudo sysctl -p /etc/sysctl.d/60-lodesman.conf",
                      facts.wanted_bytes)};
}

}  // namespace lodesman::cli
