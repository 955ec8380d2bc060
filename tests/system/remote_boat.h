// SPDX-License-Identifier: Apache-2.0
// A boat of two real processes that is commanded from beyond loopback, by `lodesman` as a user
// would.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "high_level/mission/token_file.h"
#include "tests/system/boat.h"
#include "tests/system/listening_port.h"

namespace lodesman::testing {

class RemoteBoat {
 public:
  // `own`: an IPv4 address of this machine that is not loopback.
  RemoteBoat(const Scratch& scratch, std::string own)
      : own_{std::move(own)}, token_file_{scratch.file("boat.token")} {
    make_token_file(token_file_);
    token_ = read_token(token_file_);
    const auto water = scratch.file("water.toml", scenario_text(60.0, 600.0));
    const std::string config =
        scratch
            .file("boat.toml", "[boat]\nsegment = \"" + segment_ +
                                   "\"\n[simulation]\nscenario = \"" + water.string() +
                                   "\"\n[command_socket]\nport = 0\naddress = \"" + own_ +
                                   "\"\ntoken_file = \"" + token_file_.string() + "\"\n")
            .string();
    const std::vector<std::string> arguments{"--config", config};
    low_ = std::make_unique<ChildProcess>("lodesman-low", arguments);
    high_ = std::make_unique<ChildProcess>("lodesman-high", arguments);
    board_.emplace(SharedBlackboard::observe(segment_, kPatience));
    mission_.emplace((*board_)->mission_status);
    thrust_.emplace((*board_)->thrust_applied);
    const bool up = eventually([&] {
      port_ = static_cast<std::uint16_t>(listening_port(high_->pid()));
      return port_ != 0 && find_token_file(port_).has_value() && mission_->latest() != nullptr;
    });
    if (!up) {
      throw std::runtime_error("the boat does not come up");
    }
  }
  RemoteBoat(const RemoteBoat&) = delete;
  RemoteBoat& operator=(const RemoteBoat&) = delete;
  ~RemoteBoat() {
    high_.reset();
    low_.reset();
    board_.reset();
    remove_dead_segment(segment_);
  }

  [[nodiscard]] const std::string& host() const { return own_; }
  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] const fs::path& token_file() const { return token_file_; }
  [[nodiscard]] const std::string& token() const { return token_; }
  // Words of `lodesman` to a port of this machine, by the boat's token file.
  [[nodiscard]] std::vector<std::string> words(std::vector<std::string> command,
                                               std::uint16_t port) const {
    command.insert(command.end(), {"--host", own_, "--port", std::to_string(port), "--token-file",
                                   token_file_.string(), "--quiet"});
    return command;
  }
  // Their exit status.
  [[nodiscard]] int tell(const std::vector<std::string>& command, std::uint16_t port) const {
    ChildProcess teller{"lodesman", words(command, port)};
    return eventually([&] { return teller.ended().has_value(); })
               ? teller.exit_status().value_or(-1)
               : -1;
  }
  [[nodiscard]] int tell(const std::vector<std::string>& command) const {
    return tell(command, port_);
  }
  // Under way to a place that is far enough, as soon as it is ready.
  [[nodiscard]] bool sails() {
    return eventually([&] {
             return tell({"goto", "0,50"}) == 0;
           }) &&
           eventually([&] { return drives(thrust_->latest()); });
  }
  [[nodiscard]] MissionStatus mission() { return await_first(*mission_).value; }
  [[nodiscard]] bool becomes(MissionState state) {
    return eventually([&] { return mission().state == state; });
  }
  [[nodiscard]] Reader<ThrustApplied>& thrust() { return *thrust_; }

 private:
  std::string own_;
  fs::path token_file_;
  std::string token_;
  std::string segment_ = "lodesman-test-remote-" + std::to_string(getpid());
  std::unique_ptr<ChildProcess> low_;
  std::unique_ptr<ChildProcess> high_;
  std::optional<SharedBlackboard> board_;
  std::optional<Reader<MissionStatus>> mission_;
  std::optional<Reader<ThrustApplied>> thrust_;
  std::uint16_t port_ = 0;
};

}  // namespace lodesman::testing
