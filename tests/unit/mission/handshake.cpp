// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/handshake.h"

#include <nlohmann/json.hpp>
#include <set>

#include "tests/support/catch.h"

using namespace lodesman;

namespace {

const std::string kHeldToken = "000102030405060708090a0b0c0d0e0f101112131415161718191a1b1c1d1e1f";
const std::string kHeldAbortToken = "e" + kHeldToken.substr(1);
const std::string kHeldViewToken = "f" + kHeldToken.substr(1);
const std::vector<CommandTokens> kHeldTokens{{kHeldToken, kHeldAbortToken, kHeldViewToken}};

// 32 bytes that count up.
Digest counting_from(std::uint8_t first) {
  Digest digest{};
  for (std::uint8_t& byte : digest) {
    byte = first++;
  }
  return digest;
}
const Nonces kNonces{counting_from(0x20), counting_from(0x40)};

std::string answer_of(const Digest& client_nonce, const Digest& proof) {
  return R"({"handshake":1,"client_nonce":")" + to_hex(client_nonce) + R"(","proof":")" +
         to_hex(proof) + "\"}";
}
std::string good_answer() { return answer_of(kNonces.client, client_proof(kHeldToken, kNonces)); }

bool is_refused(const BoatHandshake::Verdict& verdict, const std::string& reason) {
  return verdict.scope == Scope::kNone && verdict.reply == refusal(reason) &&
         verdict.keys.to_boat == Digest{} && verdict.keys.to_client == Digest{};
}

}  // namespace

// By `printf '...' | openssl dgst -sha256 -hmac TOKEN`, as docs/wire/command_socket.md shows, and
// by Python's hmac and hashlib.
TEST_CASE("handshake: proofs and keys are those that another program computes",
          "[high_level][mission]") {
  CHECK(to_hex(client_proof(kHeldToken, kNonces)) ==
        "fd62195b3c6a12e769fe1ee73bdac911cb1c41c90d467fff25d786aa9e7ca745");
  CHECK(to_hex(boat_proof(kHeldToken, kNonces, Scope::kCommand)) ==
        "d30a287391e9c16b5c33b21c297cefd76c1c12dae72743bedfdcd3fd3a6d1600");
  CHECK(to_hex(boat_proof(kHeldToken, kNonces, Scope::kAbort)) ==
        "b60857c13b82a8866a27bdbd496dbef6709d465faa5f4949ba0f08d6702e5e97");
  CHECK(to_hex(boat_proof(kHeldToken, kNonces, Scope::kView)) ==
        "6adcc48179589ed3120d8696abade0f380b045d7cff4584f09151177c4229c35");
  const SessionKeys keys = session_keys(kHeldToken, kNonces, Scope::kCommand);
  CHECK(to_hex(keys.to_boat) == "42444ee3646945957edd455a23da5b7f67f3b669f528f41751fa07dc8d477aa2");
  CHECK(to_hex(keys.to_client) ==
        "f62f550c9addef5c435367adb45b4d4acb5af093016186826623d2f9350ea16b");
}

TEST_CASE("handshake: both ends prove the token and have the same keys", "[high_level][mission]") {
  for (const auto& [token, scope] : {std::pair{kHeldToken, Scope::kCommand},
                                     {kHeldAbortToken, Scope::kAbort},
                                     {kHeldViewToken, Scope::kView}}) {
    const BoatHandshake boat{random_digest()};
    ClientHandshake client{token, random_digest()};
    REQUIRE_FALSE(client.hear_challenge(boat.challenge()));
    CHECK(boat.challenge().find(token) == std::string::npos);
    CHECK(client.answer().find(token) == std::string::npos);
    const auto verdict = boat.judge(client.answer(), kHeldTokens);
    CHECK(verdict.scope == scope);
    CHECK(verdict.reply.find(token) == std::string::npos);
    REQUIRE_FALSE(client.hear_proof(verdict.reply));
    CHECK(client.keys().to_boat == verdict.keys.to_boat);
    CHECK(client.keys().to_client == verdict.keys.to_client);
    CHECK(client.keys().to_boat != client.keys().to_client);
  }
}

TEST_CASE("handshake: an answer to another challenge is worth nothing", "[high_level][mission]") {
  CHECK(BoatHandshake{kNonces.boat}.judge(good_answer(), kHeldTokens).scope == Scope::kCommand);
  CHECK(
      is_refused(BoatHandshake{random_digest()}.judge(good_answer(), kHeldTokens), "wrong proof"));
}

TEST_CASE("handshake: a wrong token, one that is none and a proof that is off by a bit are refused",
          "[high_level][mission]") {
  const BoatHandshake boat{kNonces.boat};
  const std::string wrong(64, 'a');
  CHECK(is_refused(boat.judge(answer_of(kNonces.client, client_proof(wrong, kNonces)), kHeldTokens),
                   "wrong proof"));
  // A token that the boat does not have is nobody's, not everybody's.
  const std::vector<CommandTokens> one{{kHeldToken, "", ""}};
  CHECK(is_refused(boat.judge(answer_of(kNonces.client, client_proof("", kNonces)), one),
                   "wrong proof"));
  for (std::size_t bit = 0; bit < 256; ++bit) {
    Digest proof = client_proof(kHeldToken, kNonces);
    proof[bit / 8] = static_cast<std::uint8_t>(proof[bit / 8] ^ (1U << (bit % 8)));
    CHECK(is_refused(boat.judge(answer_of(kNonces.client, proof), kHeldTokens), "wrong proof"));
  }
}

// What one end says is no proof of the other.
TEST_CASE("handshake: the boat's proof is no client's, nor the client's a boat's",
          "[high_level][mission]") {
  const BoatHandshake boat{kNonces.boat};
  const Digest reflected = boat_proof(kHeldToken, kNonces, Scope::kCommand);
  CHECK(is_refused(boat.judge(answer_of(kNonces.client, reflected), kHeldTokens), "wrong proof"));
  ClientHandshake client{kHeldToken, kNonces.client};
  REQUIRE_FALSE(client.hear_challenge(boat.challenge()));
  CHECK(client.hear_proof(R"({"handshake":1,"scope":"command","proof":")" +
                          to_hex(client_proof(kHeldToken, kNonces)) + "\"}"));
}

TEST_CASE("handshake: a boat that does not hold the token, or claims another scope, is no boat",
          "[high_level][mission]") {
  const BoatHandshake boat{kNonces.boat};
  for (const std::string& proof :
       {to_hex(boat_proof(std::string(64, 'a'), kNonces, Scope::kCommand)),
        to_hex(boat_proof(kHeldToken, kNonces, Scope::kView)), std::string{"00"}, std::string{}}) {
    ClientHandshake client{kHeldToken, kNonces.client};
    REQUIRE_FALSE(client.hear_challenge(boat.challenge()));
    const auto wrong =
        client.hear_proof(R"({"handshake":1,"scope":"command","proof":")" + proof + "\"}");
    REQUIRE(wrong);
    CHECK(wrong->starts_with("does not prove that it holds the token"));
    CHECK(client.keys().to_boat == Digest{});
  }
}

TEST_CASE("handshake: another version is refused by both ends", "[high_level][mission]") {
  const BoatHandshake boat{kNonces.boat};
  std::string answer = good_answer();
  answer.replace(answer.find(":1"), 2, ":2");
  CHECK(is_refused(boat.judge(answer, kHeldTokens), "this is handshake 1"));
  std::string challenge = boat.challenge();
  challenge.replace(challenge.find(":1"), 2, ":2");
  ClientHandshake client{kHeldToken, kNonces.client};
  const auto wrong = client.hear_challenge(challenge);
  REQUIRE(wrong);
  CHECK(wrong->starts_with("speaks another handshake than 1"));
  CHECK(client.answer().empty());
}

TEST_CASE("handshake: a line that is no answer is refused, with a token in the clear too",
          "[high_level][mission]") {
  const BoatHandshake boat{kNonces.boat};
  for (const std::string& line :
       {std::string{}, std::string{"{}"}, std::string{"[1]"}, std::string{R"({"handshake":1})"},
        R"({"command":"abort","token":")" + kHeldToken + "\"}",
        std::string{R"({"handshake":1,"client_nonce":5,"proof":6})"},
        R"({"handshake":"1","client_nonce":")" + to_hex(kNonces.client) + R"(","proof":")" +
            to_hex(client_proof(kHeldToken, kNonces)) + "\"}"}) {
    CHECK(is_refused(boat.judge(line, kHeldTokens),
                     "beyond loopback a session begins with the answer to the challenge"));
  }
  // Digits are 0-9 and a-f, and 64 of them.
  std::string capital = good_answer();
  std::transform(capital.begin(), capital.end(), capital.begin(),
                 [](char c) { return c == 'f' ? 'F' : c; });
  CHECK(boat.judge(capital, kHeldTokens).scope == Scope::kNone);
}

TEST_CASE("handshake: what an unknown end says does not reach a terminal as it is",
          "[high_level][mission]") {
  ClientHandshake client{kHeldToken, kNonces.client};
  REQUIRE_FALSE(client.hear_challenge(BoatHandshake{kNonces.boat}.challenge()));
  const auto wrong =
      client.hear_proof(R"({"ok":false,"error":"\u001b[2Jno\n)" + std::string(5000, 'x') + "\"}");
  REQUIRE(wrong);
  CHECK(wrong->find('\x1b') == std::string::npos);
  CHECK(wrong->find('\n') == std::string::npos);
  CHECK(wrong->size() < 300);
}

TEST_CASE("handshake: no two nonces are alike", "[high_level][mission]") {
  std::set<std::string> nonces;
  for (int i = 0; i < 1000; ++i) {
    nonces.insert(to_hex(random_digest()));
  }
  CHECK(nonces.size() == 1000);
}
