// SPDX-License-Identifier: Apache-2.0
// Somebody in between: takes a client's connection, makes one to the boat, hands on what either
// says line by line, keeps all of it, and changes what a test tells it to. A thread of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace lodesman::testing {

enum class RelayWay { kToBoat, kToClient };

class Relay {
 public:
  // What is handed on in the place of a line, both with their line feeds.
  using Change = std::function<std::string(RelayWay way, const std::string& line)>;

  Relay(
      const std::string& host, std::uint16_t boat_port,
      Change change = [](RelayWay, const std::string& line) { return line; });
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;
  ~Relay();

  [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
  // All that was said that way so far, as it came in.
  [[nodiscard]] std::string heard(RelayWay way) const;
  // From now on nothing is handed on, and no connection ends: the link is dead.
  void fall_silent() noexcept { silent_ = true; }

 private:
  void serve();
  void hand_on(int client);

  std::string host_;
  std::uint16_t boat_port_;
  Change change_;
  int listener_ = -1;
  std::uint16_t port_ = 0;
  mutable std::mutex mutex_;
  std::string to_boat_;
  std::string to_client_;
  std::atomic<bool> silent_{false};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lodesman::testing
