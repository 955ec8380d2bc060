// SPDX-License-Identifier: Apache-2.0
// The command socket beyond loopback: over an address of this machine that is none.
#include <sys/socket.h>

#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "high_level/mission/command_socket.h"
#include "high_level/mission/proof_limit.h"
#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"
#include "tests/support/far_client.h"
#include "tests/support/own_address.h"

using namespace lodesman;
using namespace lodesman::testing;
using std::chrono::milliseconds;

namespace {

const std::string kRunToken(64, 'a');
const std::string kLastingToken(64, 'b');
const std::string kLastingAbortToken(64, 'c');
const std::string kLastingViewToken(64, 'd');

const std::string kAbort = R"({"command":"abort"})";
const std::string kHold = R"({"command":"hold"})";

CommandSocketOptions options_at(const std::string& address) {
  CommandSocketOptions options{address, 0, {kRunToken, "", ""}};
  options.lasting_tokens = {kLastingToken, kLastingAbortToken, kLastingViewToken};
  return options;
}

// Says what it was asked for, by which scope.
CommandHandler tell_scope(std::atomic<int>& handled) {
  return [&handled](const CommandRequest& request) -> Answer {
    ++handled;
    return [reply = R"({"did":")" + request.command + R"(","scope":)" +
                    std::to_string(static_cast<int>(request.scope)) + "}"] { return reply; };
  };
}
std::string did(const std::string& command, Scope scope) {
  return R"({"did":")" + command + R"(","scope":)" + std::to_string(static_cast<int>(scope)) + "}";
}

// A socket on all addresses, and this machine's own beyond loopback.
struct FarBench {
  explicit FarBench(const std::string& own, const CommandSocketOptions& options)
      : address{own},
        socket{options, tell_scope(handled), {{}, {}, [this](const std::string& from) {
                                                refused += from == address ? 1 : 0;
                                              }}} {}
  explicit FarBench(const std::string& own) : FarBench{own, options_at(own)} {}
  [[nodiscard]] FarClient far() const { return {address, socket.port()}; }
  [[nodiscard]] FarClient near() const { return {"127.0.0.1", socket.port()}; }

  std::string address;
  std::atomic<int> handled{0};
  std::atomic<int> refused{0};
  CommandSocket socket;
};

}  // namespace

TEST_CASE("far sessions: who proves a token is obeyed by its scope, over IPv4 and IPv6",
          "[high_level][mission]") {
  for (const int family : {AF_INET, AF_INET6}) {
    const auto own = own_address(family);
    if (!own) {
      continue;
    }
    for (const std::string& listen : {*own, std::string{family == AF_INET ? "0.0.0.0" : "::"}}) {
      FarBench bench{*own, options_at(listen)};
      for (const auto& [token, scope] : {std::pair{kLastingToken, Scope::kCommand},
                                         {kLastingAbortToken, Scope::kAbort},
                                         {kLastingViewToken, Scope::kView}}) {
        FarClient client = bench.far();
        REQUIRE(client.prove(token));
        CHECK(client.ask(kAbort) == did("abort", scope));
        CHECK(client.ask(kHold) == did("hold", scope));
      }
      // Whoever is aboard gets in as before, by the token of this run.
      FarClient near = bench.near();
      near.send(R"({"command":"abort","token":")" + kRunToken + "\"}");
      CHECK(near.line() == did("abort", Scope::kCommand));
    }
  }
}

TEST_CASE("far sessions: nothing is obeyed in the clear, and no token is looked at",
          "[high_level][mission]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  FarBench bench{*own};
  for (const std::string& token : {kLastingToken, kRunToken, std::string{}}) {
    FarClient client = bench.far();
    const std::string challenge = client.challenge();
    CHECK(challenge.find("boat_nonce") != std::string::npos);
    client.send(R"({"command":"abort","token":")" + token + "\"}");
    CHECK(client.line() ==
          refusal("beyond loopback a session begins with the answer to the challenge"));
    CHECK_FALSE(client.line());
  }
  // Nor after the proof: in the clear, or a token in what is sealed.
  FarClient clear = bench.far();
  REQUIRE(clear.prove(kLastingToken));
  clear.send(R"({"command":"abort","token":")" + kLastingToken + "\"}");
  CHECK(clear.line());
  CHECK_FALSE(clear.line());
  FarClient sealed = bench.far();
  REQUIRE(sealed.prove(kLastingToken));
  const auto refused = sealed.ask(R"({"command":"abort","token":")" + kLastingToken + "\"}");
  REQUIRE(refused);
  CHECK(refused->find("a token is never sent where it was proved") != std::string::npos);
  CHECK(bench.handled == 0);
}

TEST_CASE("far sessions: a wrong token and one of this run alone prove nothing, one guess each",
          "[high_level][mission]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  FarBench bench{*own};
  for (const std::string& token : {std::string(64, 'e'), kRunToken, std::string{}}) {
    FarClient client = bench.far();
    const std::string challenge = client.challenge();
    CHECK(client.answer(token, challenge) == refusal("wrong proof"));
    CHECK(client.answer(kLastingToken, challenge).empty());  // the session has ended
  }
  CHECK(bench.handled == 0);
}

TEST_CASE("far sessions: what was recorded is worth nothing in another session or in the same",
          "[high_level][mission]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  FarBench bench{*own};
  FarClient client = bench.far();
  REQUIRE(client.prove(kLastingToken));
  const std::string abort = client.lines().seal(kAbort);
  client.send(abort);
  CHECK(client.line());
  REQUIRE(bench.handled == 1);
  // The line again; it ends the session, with a reply that is the boat's.
  client.send(abort);
  const auto first = client.line();
  REQUIRE(first);
  CHECK_FALSE(client.line());
  FarClient other = bench.far();
  REQUIRE(other.prove(kLastingToken));
  other.send(abort);
  CHECK(other.line());
  CHECK_FALSE(other.line());
  // Out of order.
  FarClient swapped = bench.far();
  REQUIRE(swapped.prove(kLastingToken));
  const std::string one = swapped.lines().seal(kAbort);
  swapped.send(swapped.lines().seal(kHold));
  CHECK(swapped.line());
  swapped.send(one);
  CHECK_FALSE(swapped.line());
  CHECK(bench.handled == 1);
}

TEST_CASE("far sessions: on loopback a token may be proved instead of shown, of the run or lasting",
          "[high_level][mission]") {
  FarBench bench{"127.0.0.1", options_at("127.0.0.1")};
  for (const std::string& token : {kLastingToken, kRunToken}) {
    FarClient client = bench.near();
    client.send(handshake_request());
    REQUIRE(client.prove(token));
    CHECK(client.ask(kAbort) == did("abort", Scope::kCommand));
  }
  FarClient wrong = bench.near();
  wrong.send(handshake_request());
  CHECK_FALSE(wrong.prove(std::string(64, 'e')));
  // As its first line only.
  FarClient late = bench.near();
  late.send(R"({"command":"abort","token":")" + kRunToken + "\"}");
  CHECK(late.line());
  late.send(handshake_request());
  CHECK(late.line().value_or("").find("a command is a line") != std::string::npos);
  CHECK_FALSE(late.line());
}

TEST_CASE("far sessions: silent, slow and half-open ones end, before and after the proof",
          "[high_level][mission]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  CommandSocketOptions options = options_at(*own);
  options.stranger_idle_limit = milliseconds{200};
  options.far_idle_limit = milliseconds{400};
  FarBench bench{*own, options};
  FarClient silent = bench.far();
  FarClient half_open = bench.far();
  half_open.send(R"({"handshake":1,)");
  FarClient asks = bench.far();
  asks.send(handshake_request());
  FarClient fell_silent = bench.far();
  REQUIRE(fell_silent.prove(kLastingToken));
  CHECK(fell_silent.ask(kHold) == did("hold", Scope::kCommand));
  for (FarClient* client : {&silent, &half_open, &asks, &fell_silent}) {
    while (client->line()) {
    }
  }
  // A stranger's line is short, and it asks but once.
  FarClient endless = bench.far();
  CHECK_FALSE(endless.challenge().empty());
  endless.send(std::string(5000, 'x'));
  CHECK_FALSE(endless.line());
  FarClient asks_twice = bench.far();
  asks_twice.send(handshake_request() + "\n" + handshake_request());
  CHECK_FALSE(asks_twice.challenge().empty());
  CHECK(asks_twice.line().value_or("").find("\"ok\":false") != std::string::npos);
  CHECK_FALSE(asks_twice.line());
  FarClient client = bench.far();
  REQUIRE(client.prove(kLastingToken));
  CHECK(client.ask(kAbort) == did("abort", Scope::kCommand));
}

TEST_CASE("far sessions: whoever holds the token gets in while others guess and crowd",
          "[high_level][mission]") {
  const auto own = own_address(AF_INET);
  if (!own) {
    return;
  }
  FarBench bench{*own};
  // More failures than are let pass without a pause, from the operator's own address.
  for (int i = 0; i < 2 * kNetworkFailures; ++i) {
    FarClient guess = bench.far();
    CHECK_FALSE(guess.prove(std::string(64, 'e')));
  }
  CHECK(bench.refused == 2 * kNetworkFailures);
  FarClient client = bench.far();
  REQUIRE(client.prove(kLastingToken));
  CHECK(client.ask(kAbort) == did("abort", Scope::kCommand));
  // A crowd that connects and is silent, after which the session that proved its token is still
  // there, and whoever is aboard gets in.
  std::vector<std::unique_ptr<FarClient>> crowd;
  for (std::size_t i = 0; i < 2 * kMaxSessions; ++i) {
    crowd.push_back(std::make_unique<FarClient>(*own, bench.socket.port()));
  }
  CHECK(client.ask(kHold) == did("hold", Scope::kCommand));
  FarClient near = bench.near();
  near.send(R"({"command":"abort","token":")" + kRunToken + "\"}");
  CHECK(near.line() == did("abort", Scope::kCommand));
}

TEST_CASE("far sessions: no session begins with the nonce of another", "[high_level][mission]") {
  FarBench bench{"127.0.0.1", options_at("127.0.0.1")};
  std::vector<std::string> challenges;
  for (int i = 0; i < 100; ++i) {
    FarClient client = bench.near();
    client.send(handshake_request());
    challenges.push_back(client.challenge());
  }
  std::sort(challenges.begin(), challenges.end());
  CHECK(std::adjacent_find(challenges.begin(), challenges.end()) == challenges.end());
}
