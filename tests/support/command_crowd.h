// SPDX-License-Identifier: Apache-2.0
// A crowd at a boat's command socket: many connections, and as many orders a second as are asked
// for. What was put out comes back. A thread of its own.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace lodesman::testing {

// {"command": "...", "token": "..."} and the line's end.
[[nodiscard]] std::string command_text(const std::string& command, const std::string& token);

// One connection, one command: the boat's line, empty where it gave none within 20 s.
[[nodiscard]] std::string ask_boat(std::uint16_t port, const std::string& text);

class CommandCrowd {
 public:
  struct Options {
    std::uint16_t port = 0;
    int connections = 0;
    int lines_per_s = 0;  // all connections together; 0: they connect and are silent
    std::string line;
  };

  explicit CommandCrowd(Options options);
  CommandCrowd(const CommandCrowd&) = delete;
  CommandCrowd& operator=(const CommandCrowd&) = delete;
  ~CommandCrowd();

  [[nodiscard]] std::uint64_t connected() const noexcept { return connected_; }
  [[nodiscard]] std::uint64_t sent() const noexcept { return sent_; }
  [[nodiscard]] std::uint64_t answered() const noexcept { return answered_; }

 private:
  struct Member {
    int socket = -1;
    bool up = false;
    std::size_t owed = 0;  // bytes of a line begun
  };

  void crowd();
  void come(Member& member) const;
  void send_line(Member& member);
  void hear(Member& member);

  Options options_;
  std::vector<Member> members_;
  std::atomic<std::uint64_t> connected_{0};  // since the beginning, those that came back again
  std::atomic<std::uint64_t> sent_{0};
  std::atomic<std::uint64_t> answered_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace lodesman::testing
