// SPDX-License-Identifier: Apache-2.0
// How a client and the boat prove to each other that they hold the same token, without saying it:
// challenge and response with HMAC-SHA256, both ways, and the keys of the session that follows.
// Values alone: no socket, no time. Any thread. To the byte, with vectors:
// docs/wire/command_socket.md.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "high_level/mission/command_line.h"
#include "high_level/mission/message_code.h"
#include "high_level/mission/sealed_lines.h"

namespace lodesman {

inline constexpr int kHandshakeVersion = 1;

// One of each session's ends; neither is ever used twice.
struct Nonces {
  Digest boat{};
  Digest client{};
};

[[nodiscard]] Digest client_proof(const std::string& token, const Nonces& nonces);
[[nodiscard]] Digest boat_proof(const std::string& token, const Nonces& nonces, Scope scope);
[[nodiscard]] SessionKeys session_keys(const std::string& token, const Nonces& nonces, Scope scope);

// The line by which a client asks for the challenge, and whether a line is that.
[[nodiscard]] std::string handshake_request();
[[nodiscard]] bool is_handshake_request(const std::string& line);

// The boat's side.
class BoatHandshake {
 public:
  explicit BoatHandshake(const Digest& nonce) noexcept : nonce_{nonce} {}

  [[nodiscard]] std::string challenge() const;

  struct Verdict {
    Scope scope = Scope::kNone;  // of the token that was proved; none: nothing was
    std::string reply;           // the boat's own proof, or why it is refused
    SessionKeys keys;            // where something was proved
  };
  // Of the client's answer, by the tokens that count here. It may be asked once.
  [[nodiscard]] Verdict judge(const std::string& answer,
                              std::span<const CommandTokens> tokens) const;

 private:
  Digest nonce_;
};

// The client's side. Both steps give what they found wrong, as the end of a sentence whose subject
// is the address of the boat; nothing where all is well.
class ClientHandshake {
 public:
  ClientHandshake(std::string token, const Digest& nonce)
      : token_{std::move(token)}, nonces_{{}, nonce} {}

  // What to send is then answer().
  [[nodiscard]] std::optional<std::string> hear_challenge(const std::string& line);
  [[nodiscard]] const std::string& answer() const noexcept { return answer_; }
  // The keys are then keys().
  [[nodiscard]] std::optional<std::string> hear_proof(const std::string& line);
  [[nodiscard]] const SessionKeys& keys() const noexcept { return keys_; }

 private:
  std::string token_;
  Nonces nonces_;
  std::string answer_;
  SessionKeys keys_;
};

}  // namespace lodesman
