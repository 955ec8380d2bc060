// SPDX-License-Identifier: Apache-2.0
// A client of the command socket that proves its token, and can be told to misbehave.
#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <optional>
#include <string>

#include "high_level/mission/handshake.h"

namespace lodesman::testing {

class FarClient {
 public:
  FarClient(const std::string& host, std::uint16_t port) {
    stream_.expires_after(std::chrono::seconds{20});
    stream_.connect(host, std::to_string(port));
  }

  void send(const std::string& line) { stream_ << line << "\n" << std::flush; }
  // Nothing where the session has ended.
  [[nodiscard]] std::optional<std::string> line() {
    std::string text;
    return std::getline(stream_, text) ? std::optional{text} : std::nullopt;
  }

  // The boat's challenge, once it has come or been asked for.
  [[nodiscard]] std::string challenge() { return line().value_or(""); }
  // What the boat says to the answer.
  [[nodiscard]] std::string answer(const std::string& token, const std::string& challenge) {
    handshake_.emplace(token, random_digest());
    static_cast<void>(handshake_->hear_challenge(challenge));
    send(handshake_->answer());
    return line().value_or("");
  }
  // Whether both ends have proved the token.
  [[nodiscard]] bool prove(const std::string& token) {
    const std::string proof = answer(token, challenge());
    if (proof.empty() || handshake_->hear_proof(proof)) {
      return false;
    }
    lines_.emplace(handshake_->keys(), SessionEnd::kClient);
    return true;
  }

  [[nodiscard]] SealedLines& lines() { return *lines_; }
  // The boat's answer to the next line; nothing where it is none, or none of the boat's.
  [[nodiscard]] std::optional<std::string> ask(const std::string& object) {
    send(lines_->seal(object));
    const auto text = line();
    return text ? lines_->open(*text) : std::nullopt;
  }

 private:
  boost::asio::ip::tcp::iostream stream_;
  std::optional<ClientHandshake> handshake_;
  std::optional<SealedLines> lines_;
};

}  // namespace lodesman::testing
