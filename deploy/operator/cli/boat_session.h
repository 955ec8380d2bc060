// SPDX-License-Identifier: Apache-2.0
// A conversation between the operator's commands and a boat's command socket. The main thread.
#pragma once

#include <CLI/CLI.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "deploy/operator/cli/common_options.h"
#include "mid_level/base/time.h"

namespace lodesman::cli {

struct OperatorOptions {
  CommonOptions common;
  std::string host = "127.0.0.1";
  std::optional<std::uint16_t> port;  // instead of the configuration's
  std::string token_file;             // instead of the configuration's, or the boat's own
};

void add_boat_options(CLI::App& command, OperatorOptions& options);

// How long the boat may take for a word.
inline constexpr Duration kBoatPatience = std::chrono::seconds{5};

struct Boat {
  std::string host;
  std::uint16_t port = 0;
  std::string token;
};

// Thrown where none has left its token, or none answers.
class NoBoat : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Boat find_boat(const OperatorOptions& options);
[[nodiscard]] NoBoat no_answer(const Boat& boat);

class BoatSession {
 public:
  explicit BoatSession(const Boat& boat, Duration patience = kBoatPatience);
  // The boat's line; empty where it gave none.
  [[nodiscard]] std::string ask(nlohmann::json request, Duration patience = kBoatPatience);

 private:
  const Boat& boat_;
  boost::asio::ip::tcp::iostream stream_;
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
