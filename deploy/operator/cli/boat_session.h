// SPDX-License-Identifier: Apache-2.0
// A conversation between the operator's commands and a boat's command socket. A token that lasts is
// never sent: it is proved, as docs/wire/command_socket.md says, and the boat proves it too before
// anything is ordered. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "deploy/operator/cli/common_options.h"
#include "high_level/mission/sealed_lines.h"
#include "mid_level/base/time.h"

namespace lodesman::cli {

struct OperatorOptions {
  CommonOptions common;
  std::string host = "127.0.0.1";
  std::optional<std::uint16_t> port;  // instead of the configuration's
  std::string token_file;  // instead of the configuration's, or the boat's own of this run
};

void add_boat_options(CLI::App& command, OperatorOptions& options);

// How long the boat may take for a word.
inline constexpr Duration kBoatPatience = std::chrono::seconds{5};

// How a session shows what it may.
enum class Credential : std::uint8_t {
  kShown,   // in each line: the boat's own token of this run, on this machine
  kProved,  // by challenge and response
};

struct Boat {
  std::string host;
  std::uint16_t port = 0;
  std::string token;
  Credential credential = Credential::kShown;
};

// Thrown where none has left its token, none answers, or what answers is not the boat.
class NoBoat : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Boat find_boat(const OperatorOptions& options);
[[nodiscard]] NoBoat no_answer(const Boat& boat);

class BoatSession {
 public:
  // Throws NoBoat where who answers does not prove the token.
  explicit BoatSession(const Boat& boat, Duration patience = kBoatPatience);
  // The boat's line; empty where it gave none. Throws NoBoat where it was altered on its way.
  [[nodiscard]] std::string ask(nlohmann::json request, Duration patience = kBoatPatience);

 private:
  void prove();
  [[nodiscard]] std::string exchange(const std::string& line);
  [[nodiscard]] NoBoat fault(const std::string& what) const;

  const Boat& boat_;
  boost::asio::ip::tcp::iostream stream_;
  std::optional<SealedLines> sealed_;
};

// A refusal is 1; what may have been done or not is 4, as is whatever stops the boat and is not
// confirmed.
[[nodiscard]] int reply_status(const std::string& command, const nlohmann::ordered_json& reply);
// What the reply comes to, said as it was asked for.
[[nodiscard]] int conclude(const std::string& command, const std::string& line,
                           const OperatorOptions& options);
// One word and its reply. `name`: of the command as it was typed.
[[nodiscard]] int send(const std::string& name, const nlohmann::json& request,
                       const OperatorOptions& options);
// Says it where there is no boat.
[[nodiscard]] int or_say_why(const std::string& command, const std::function<int()>& act);

// A command that is a word and nothing else.
void add_word(CLI::App& root, const std::string& name, const std::string& description,
              int& exit_status);

}  // namespace lodesman::cli
