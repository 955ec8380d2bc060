// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/handshake.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace lodesman {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kScopes{std::pair{Scope::kView, "view"}, std::pair{Scope::kAbort, "abort"},
                             std::pair{Scope::kCommand, "command"}};

[[nodiscard]] std::string to_text(Scope scope) {
  for (const auto& [each, name] : kScopes) {
    if (each == scope) {
      return name;
    }
  }
  return "none";
}

[[nodiscard]] Scope scope_named(const std::string& text) {
  for (const auto& [scope, name] : kScopes) {
    if (name == text) {
      return scope;
    }
  }
  return Scope::kNone;
}

// What a code of the handshake is over: its purpose, and all that both ends have said. Lines of
// fixed length but for the first and the last, which are words of a short list.
[[nodiscard]] std::string transcript(const std::string& purpose, const Nonces& nonces) {
  return "lodesman handshake " + std::to_string(kHandshakeVersion) + " " + purpose + "\n" +
         to_hex(nonces.boat) + "\n" + to_hex(nonces.client) + "\n";
}
[[nodiscard]] std::string transcript(const std::string& purpose, const Nonces& nonces,
                                     Scope scope) {
  return transcript(purpose, nonces) + to_text(scope) + "\n";
}

[[nodiscard]] std::string text_at(const Json& line, const char* key) {
  return line.is_object() && line.contains(key) && line[key].is_string()
             ? line[key].get<std::string>()
             : "";
}
[[nodiscard]] std::optional<Digest> digest_at(const Json& line, const char* key) {
  return digest_of(text_at(line, key));
}

[[nodiscard]] bool has_version(const Json& line) {
  return line.is_object() && line.contains("handshake") && line["handshake"].is_number_integer();
}
[[nodiscard]] bool is_ours(const Json& line) {
  return has_version(line) && line["handshake"] == kHandshakeVersion;
}

// What somebody unknown says, harmless to a terminal.
[[nodiscard]] std::string quotable(std::string text) {
  constexpr std::size_t kMaxLength = 200;
  text.resize(std::min(text.size(), kMaxLength));
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

[[nodiscard]] Json parsed(const std::string& line) { return Json::parse(line, nullptr, false); }

}  // namespace

Digest client_proof(const std::string& token, const Nonces& nonces) {
  return message_code(token, transcript("client", nonces));
}

Digest boat_proof(const std::string& token, const Nonces& nonces, Scope scope) {
  return message_code(token, transcript("boat", nonces, scope));
}

SessionKeys session_keys(const std::string& token, const Nonces& nonces, Scope scope) {
  return {message_code(token, transcript("to boat", nonces, scope)),
          message_code(token, transcript("to client", nonces, scope))};
}

std::string handshake_request() { return Json{{"handshake", kHandshakeVersion}}.dump(); }

bool is_handshake_request(const std::string& text) {
  const Json line = parsed(text);
  return has_version(line) && line.size() == 1;
}

std::string BoatHandshake::challenge() const {
  return Json{{"handshake", kHandshakeVersion}, {"boat_nonce", to_hex(nonce_)}}.dump();
}

BoatHandshake::Verdict BoatHandshake::judge(const std::string& text,
                                            std::span<const CommandTokens> tokens) const {
  const Json answer = parsed(text);
  const auto nonce = digest_at(answer, "client_nonce");
  const auto proof = digest_at(answer, "proof");
  if (has_version(answer) && !is_ours(answer)) {
    return {Scope::kNone, refusal("this is handshake " + std::to_string(kHandshakeVersion)), {}};
  }
  if (!is_ours(answer) || !nonce || !proof) {
    return {Scope::kNone,
            refusal("beyond loopback a session begins with the answer to the challenge"),
            {}};
  }
  const Nonces nonces{nonce_, *nonce};
  Verdict verdict{Scope::kNone, refusal("wrong proof"), {}};
  // Each is tried, whichever has been found, so that all take the same time.
  for (const CommandTokens& set : tokens) {
    for (const auto& [scope, token] : {std::pair{Scope::kView, &set.view},
                                       {Scope::kAbort, &set.abort},
                                       {Scope::kCommand, &set.command}}) {
      const bool proved = same_digest(*proof, client_proof(*token, nonces)) && !token->empty();
      if (proved && scope > verdict.scope) {
        verdict = {scope,
                   Json{{"handshake", kHandshakeVersion},
                        {"scope", to_text(scope)},
                        {"proof", to_hex(boat_proof(*token, nonces, scope))}}
                       .dump(),
                   session_keys(*token, nonces, scope)};
      }
    }
  }
  return verdict;
}

std::optional<std::string> ClientHandshake::hear_challenge(const std::string& text) {
  const Json line = parsed(text);
  if (has_version(line) && !is_ours(line)) {
    return "speaks another handshake than " + std::to_string(kHandshakeVersion) +
           ": boat and lodesman must be of like versions";
  }
  const auto nonce = digest_at(line, "boat_nonce");
  if (!is_ours(line) || !nonce) {
    return "gives no challenge: it is no boat, or one that does not know this handshake";
  }
  nonces_.boat = *nonce;
  answer_ = Json{{"handshake", kHandshakeVersion},
                 {"client_nonce", to_hex(nonces_.client)},
                 {"proof", to_hex(client_proof(token_, nonces_))}}
                .dump();
  return std::nullopt;
}

std::optional<std::string> ClientHandshake::hear_proof(const std::string& text) {
  const Json line = parsed(text);
  if (const std::string reason = text_at(line, "error"); !reason.empty()) {
    return "refuses the handshake (" + quotable(reason) + "): is this its token file?";
  }
  const Scope scope = scope_named(text_at(line, "scope"));
  const auto proof = digest_at(line, "proof");
  if (!is_ours(line) || scope == Scope::kNone || !proof ||
      !same_digest(*proof, boat_proof(token_, nonces_, scope))) {
    return "does not prove that it holds the token: it is another boat, or somebody in between; "
           "nothing was ordered";
  }
  keys_ = session_keys(token_, nonces_, scope);
  return std::nullopt;
}

}  // namespace lodesman
