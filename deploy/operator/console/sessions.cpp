// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/sessions.h"

#include <algorithm>

namespace lodesman::console {
namespace {

constexpr std::size_t kTicketDigits = 32;
constexpr Duration kFirstWait = std::chrono::seconds{1};

}  // namespace

bool Sessions::may_look(Time now) {
  if (now - look_second_ >= std::chrono::seconds{1}) {
    look_second_ = now;
    looks_ = 0;
  }
  return ++looks_ <= kLooksPerSecond;
}

Scope Sessions::take_one_time_token(const std::string& token) {
  if (!one_time_ || !same_token(token, *one_time_)) {
    return Scope::kNone;
  }
  one_time_.reset();
  return Scope::kCommand;
}

Sessions::SignIn Sessions::sign_in(const std::string& token, Time now) {
  if (!may_look(now)) {
    return {nullptr, kFirstWait};
  }
  forget_the_idle(now);
  const Scope once = take_one_time_token(token);
  const Scope scope = once != Scope::kNone ? once : scope_of_(token);
  if (scope == Scope::kNone) {
    const int beyond = ++wrong_in_a_row_ - kFreeGuesses;
    if (beyond > 0) {
      constexpr int kMostDoublings = 6;
      const Duration wait = kFirstWait * (1 << std::min(beyond - 1, kMostDoublings));
      return {nullptr, std::min(kLongestWait, wait)};
    }
    return {};
  }
  wrong_in_a_row_ = 0;
  if (sessions_.size() >= kMaxSessions) {
    sessions_.erase(
        std::min_element(sessions_.begin(), sessions_.end(),
                         [](const Session& a, const Session& b) { return a.used < b.used; }));
  }
  sessions_.push_back(
      {++last_number_, scope, once != Scope::kNone ? std::string{} : token, random_digest(), now});
  return {&sessions_.back(), {}};
}

std::string Sessions::make_one_time_token() {
  one_time_ = to_hex(random_digest());
  return *one_time_;
}

void Sessions::forget_the_idle(Time now) {
  sessions_.remove_if([&](const Session& session) { return now - session.used > kIdleLimit; });
}

const Session* Sessions::find(const std::string& cookie, Time now) {
  const auto secret = digest_of(cookie);
  if (!secret) {
    return nullptr;
  }
  forget_the_idle(now);
  Session* found = nullptr;
  for (Session& session : sessions_) {
    if (same_digest(session.secret, *secret)) {
      found = &session;
    }
  }
  if (found != nullptr) {
    found->used = now;
  }
  return found;
}

const Session* Sessions::find(std::uint64_t number) const {
  const auto found = std::find_if(sessions_.begin(), sessions_.end(),
                                  [&](const Session& s) { return s.number == number; });
  return found == sessions_.end() ? nullptr : &*found;
}

bool Sessions::end(std::uint64_t number) {
  return std::erase_if(sessions_, [&](const Session& s) { return s.number == number; }) > 0;
}

std::string Sessions::make_ticket() {
  if (tickets_.size() >= kMaxTickets) {
    tickets_.erase(tickets_.begin());
  }
  tickets_.push_back(to_hex(random_digest()).substr(0, kTicketDigits));
  return tickets_.back();
}

bool Sessions::is_ticket(const std::string& ticket) const {
  bool known = false;
  for (const std::string& made : tickets_) {
    known = same_token(ticket, made) || known;
  }
  return known;
}

}  // namespace lodesman::console
