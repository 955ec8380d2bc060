// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/sessions.h"

#include <set>

#include "deploy/operator/console/token_book.h"
#include "tests/support/catch.h"

using namespace lodesman;
using namespace lodesman::console;
using std::chrono::hours;
using std::chrono::seconds;

namespace {

const std::string kRight(64, 'a');

[[nodiscard]] Sessions sessions() {
  return Sessions{
      [](const std::string& token) { return token == kRight ? Scope::kView : Scope::kNone; }};
}

[[nodiscard]] Time at(int second) { return Time{seconds{1000 + second}}; }

}  // namespace

TEST_CASE("console sessions: a right token makes a cookie of 256 random bits", "[console]") {
  Sessions book = sessions();
  std::set<std::string> secrets;
  for (int i = 0; i < 10; ++i) {
    const auto outcome = book.sign_in(kRight, at(i));
    REQUIRE(outcome.session != nullptr);
    CHECK(outcome.session->scope == Scope::kView);
    const std::string cookie = to_hex(outcome.session->secret);
    CHECK(cookie.size() == 64);
    secrets.insert(cookie);
    CHECK(book.find(cookie, at(i)) == outcome.session);
  }
  CHECK(secrets.size() == 10);
  CHECK(book.find("", at(0)) == nullptr);
  CHECK(book.find(std::string(64, '0'), at(0)) == nullptr);
}

TEST_CASE(
    "console sessions: after five wrong tokens a growing wait, which a right one does not share",
    "[console]") {
  Sessions book = sessions();
  for (int i = 0; i < 5; ++i) {
    CHECK(book.sign_in("wrong", at(i)).wait == Duration{});
  }
  Duration last{};
  for (int i = 5; i < 20; ++i) {
    const Duration wait = book.sign_in("wrong", at(i)).wait;
    CHECK(wait >= last);
    CHECK(wait >= seconds{1});
    CHECK(wait <= Sessions::kLongestWait);
    last = wait;
  }
  CHECK(last == Sessions::kLongestWait);
  CHECK(book.sign_in(kRight, at(20)).session != nullptr);
  CHECK(book.sign_in("wrong", at(21)).wait == Duration{});
}

TEST_CASE("console sessions: no more tokens are looked at in a second than set", "[console]") {
  int looks = 0;
  Sessions book{[&](const std::string& /*token*/) {
    ++looks;
    return Scope::kNone;
  }};
  for (int i = 0; i < 1000; ++i) {
    CHECK(book.sign_in("wrong", at(0)).session == nullptr);
  }
  CHECK(looks == Sessions::kLooksPerSecond);
}

TEST_CASE("console sessions: they end by a word, without use, and as their number is bounded",
          "[console]") {
  Sessions book = sessions();
  const auto first = book.sign_in(kRight, at(0));
  const std::uint64_t number = first.session->number;
  CHECK(book.end(number));
  CHECK_FALSE(book.end(number));
  const std::string idle = to_hex(book.sign_in(kRight, at(1)).session->secret);
  CHECK(book.find(idle, at(1) + hours{24}) != nullptr);
  CHECK(book.find(idle, at(2) + hours{48}) == nullptr);
  const std::string oldest = to_hex(book.sign_in(kRight, at(3)).session->secret);
  for (int i = 0; i < static_cast<int>(Sessions::kMaxSessions); ++i) {
    CHECK(book.sign_in(kRight, at(4 + i)).session != nullptr);
  }
  CHECK(book.find(oldest, at(100)) == nullptr);
}

TEST_CASE("console sessions: a one-time token signs in once, to command", "[console]") {
  Sessions book = sessions();
  const std::string token = book.make_one_time_token();
  CHECK(token.size() == 64);
  const auto outcome = book.sign_in(token, at(0));
  REQUIRE(outcome.session != nullptr);
  CHECK(outcome.session->scope == Scope::kCommand);
  CHECK(outcome.session->token.empty());
  CHECK(book.sign_in(token, at(1)).session == nullptr);
}

TEST_CASE("console sessions: a ticket is good until others have taken its place", "[console]") {
  Sessions book = sessions();
  const std::string ticket = book.make_ticket();
  CHECK(ticket.size() == 32);
  CHECK(book.is_ticket(ticket));
  CHECK_FALSE(book.is_ticket(""));
  CHECK_FALSE(book.is_ticket(ticket.substr(1)));
  for (std::size_t i = 0; i < Sessions::kMaxTickets; ++i) {
    CHECK(book.is_ticket(book.make_ticket()));
  }
  CHECK_FALSE(book.is_ticket(ticket));
}

TEST_CASE("token book: a token has the scope of its line, an empty line is nobody's", "[console]") {
  const CommandTokens tokens{std::string(64, 'a'), std::string(64, 'b'), ""};
  CHECK(scope_of(std::string(64, 'a'), tokens) == Scope::kCommand);
  CHECK(scope_of(std::string(64, 'b'), tokens) == Scope::kAbort);
  CHECK(scope_of("", tokens) == Scope::kNone);
  CHECK(scope_of(std::string(63, 'a'), tokens) == Scope::kNone);
}
