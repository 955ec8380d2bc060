// SPDX-License-Identifier: Apache-2.0
// Who has signed in to the console, by what token, and who may look on by a ticket. Secrets are
// random, kept in memory alone and compared in constant time; wrong tokens in a row cost a growing
// wait, which one that is right does not share. Time is handed in; one thread; bounded memory.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <optional>
#include <string>
#include <vector>

#include "high_level/mission/command_line.h"
#include "high_level/mission/message_code.h"
#include "mid_level/base/time.h"

namespace lodesman::console {

struct Session {
  std::uint64_t number = 0;  // > 0, never used again
  Scope scope = Scope::kNone;
  std::string token;  // empty: the boat's own of the run, whichever that is by then
  Digest secret{};    // in the browser's cookie
  Time used{};
};

class Sessions {
 public:
  static constexpr std::size_t kMaxSessions = 64;
  static constexpr std::size_t kMaxTickets = 64;
  static constexpr Duration kIdleLimit = std::chrono::hours{24};
  static constexpr int kFreeGuesses = 5;  // wrong in a row, before others have to wait
  static constexpr Duration kLongestWait = std::chrono::seconds{60};
  // Tokens looked at in a second, whoever shows them.
  static constexpr int kLooksPerSecond = 20;

  using ScopeOf = std::function<Scope(const std::string& token)>;
  explicit Sessions(ScopeOf scope_of) : scope_of_{std::move(scope_of)} {}

  struct SignIn {
    const Session* session = nullptr;  // where the token was right
    Duration wait{};                   // else: how long not to try again; 0: at once
  };
  [[nodiscard]] SignIn sign_in(const std::string& token, Time now);

  // A token that signs in once, to command whatever boat of this console runs then.
  [[nodiscard]] std::string make_one_time_token();

  // By the cookie's value; the session is used by that.
  [[nodiscard]] const Session* find(const std::string& cookie, Time now);
  [[nodiscard]] const Session* find(std::uint64_t number) const;
  // True where there was one.
  bool end(std::uint64_t number);

  // Of 128 bits, for the life of this console; the oldest gives way.
  [[nodiscard]] std::string make_ticket();
  [[nodiscard]] bool is_ticket(const std::string& ticket) const;

 private:
  [[nodiscard]] Scope take_one_time_token(const std::string& token);
  [[nodiscard]] bool may_look(Time now);
  void forget_the_idle(Time now);

  ScopeOf scope_of_;
  std::list<Session> sessions_;
  std::vector<std::string> tickets_;
  std::optional<std::string> one_time_;
  std::uint64_t last_number_ = 0;
  int wrong_in_a_row_ = 0;
  Time look_second_{};
  int looks_ = 0;
};

}  // namespace lodesman::console
