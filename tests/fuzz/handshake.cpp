// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/handshake.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "tests/fuzz/oracle.h"
#include "tests/fuzz/targets.h"

namespace lodesman::fuzz {
namespace {

using nlohmann::json;

const std::string& token() {
  static const std::string kToken(64, 'a');
  return kToken;
}
// All the same, so that a seed can hold what is right.
constexpr Nonces kNonces{};

[[nodiscard]] std::string text_at(const json& line, const char* key) {
  return line.is_object() && line.contains(key) && line[key].is_string()
             ? line[key].get<std::string>()
             : "";
}

// To the boat, as a client's answer.
void answer(const std::string& line) {
  const std::vector<CommandTokens> tokens{{token(), "", ""}};
  const auto verdict = BoatHandshake{kNonces.boat}.judge(line, tokens);
  const json answer = json::parse(line, nullptr, false);
  const auto nonce = digest_of(text_at(answer, "client_nonce"));
  const bool right =
      nonce && text_at(answer, "proof") == to_hex(client_proof(token(), {kNonces.boat, *nonce})) &&
      answer.contains("handshake") && answer["handshake"].is_number_integer() &&
      answer["handshake"] == kHandshakeVersion;
  require(right == (verdict.scope == Scope::kCommand),
          "a token is taken for proved that was not, or the other way round");
  require(right || verdict.scope == Scope::kNone, "a token is taken for another");
  const json reply = json::parse(verdict.reply, nullptr, false);
  require(reply.is_object() && verdict.reply.find('\n') == std::string::npos,
          "a reply is no JSON document on one line");
}

// To the client, as a boat's challenge and as its proof.
void boat_lines(const std::string& line) {
  ClientHandshake client{token(), kNonces.client};
  if (const auto wrong = client.hear_challenge(line)) {
    require(client.answer().empty(), "what is no challenge is answered");
    require(!client.hear_challenge(BoatHandshake{kNonces.boat}.challenge()),
            "a challenge is refused");
  }
  ClientHandshake other{token(), kNonces.client};
  require(!other.hear_challenge(BoatHandshake{kNonces.boat}.challenge()), "a challenge is refused");
  const auto wrong = other.hear_proof(line);
  const json proof = json::parse(line, nullptr, false);
  require(wrong ||
              text_at(proof, "proof") == to_hex(boat_proof(token(), kNonces, Scope::kCommand)) ||
              text_at(proof, "proof") == to_hex(boat_proof(token(), kNonces, Scope::kAbort)) ||
              text_at(proof, "proof") == to_hex(boat_proof(token(), kNonces, Scope::kView)),
          "a boat is believed that proved nothing");
  require(!wrong || wrong->find_first_of("\n\r\x1b") == std::string::npos,
          "an unknown boat writes on a terminal");
}

// As a sealed line: only the one that was sealed is opened.
void sealed(const std::string& line) {
  const SessionKeys keys = session_keys(token(), kNonces, Scope::kCommand);
  SealedLines boat{keys, SessionEnd::kBoat};
  const auto opened = boat.open(line);
  require(!opened || SealedLines{keys, SessionEnd::kClient}.seal(*opened) == line,
          "a line is opened that nobody sealed");
}

}  // namespace

void handshake(std::string_view input) {
  const std::string line{input};
  answer(line);
  boat_lines(line);
  sealed(line);
  static_cast<void>(is_handshake_request(line));
}

}  // namespace lodesman::fuzz
