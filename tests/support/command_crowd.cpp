// SPDX-License-Identifier: Apache-2.0
#include "tests/support/command_crowd.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTurn{5};
constexpr int kComersPerTurn = 10;  // 2,000 new connections a second

[[nodiscard]] sockaddr_in loopback(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  return address;
}

[[nodiscard]] bool connect_to(int socket, std::uint16_t port) {
  const sockaddr_in address = loopback(port);
  return connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

void allow_descriptors(int count) {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) == 0) {
    limit.rlim_cur =
        std::min(limit.rlim_max, std::max(limit.rlim_cur, static_cast<rlim_t>(count + 256)));
    setrlimit(RLIMIT_NOFILE, &limit);
  }
}

void leave(int& socket) {
  if (socket >= 0) {
    close(std::exchange(socket, -1));
  }
}

}  // namespace

std::string command_text(const std::string& command, const std::string& token) {
  return R"({"command":")" + command + R"(","token":")" + token + "\"}\n";
}

std::string ask_boat(std::uint16_t port, const std::string& text) {
  int client = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const timeval patience{20, 0};
  setsockopt(client, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  std::string line;
  if (connect_to(client, port) &&
      send(client, text.data(), text.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(text.size())) {
    std::array<char, 4096> part{};
    ssize_t length = 0;
    while (line.find('\n') == std::string::npos &&
           (length = recv(client, part.data(), part.size(), 0)) > 0) {
      line.append(part.data(), static_cast<std::size_t>(length));
    }
  }
  leave(client);
  return line.substr(0, line.find('\n'));
}

CommandCrowd::CommandCrowd(Options options)
    : options_{std::move(options)}, members_(static_cast<std::size_t>(options_.connections)) {
  allow_descriptors(options_.connections);
  thread_ = std::thread{[this] { crowd(); }};
}

CommandCrowd::~CommandCrowd() {
  stop_ = true;
  thread_.join();
  for (Member& member : members_) {
    leave(member.socket);
  }
}

void CommandCrowd::crowd() {
  std::size_t next = 0;
  auto turn = std::chrono::steady_clock::now();
  double due = 0.0;
  while (!stop_) {
    turn += kTurn;
    std::this_thread::sleep_until(turn);
    int comers = kComersPerTurn;
    for (Member& member : members_) {
      if (member.socket < 0 && comers-- > 0) {
        come(member);
      }
      hear(member);
    }
    due += options_.lines_per_s * std::chrono::duration<double>{kTurn}.count();
    for (std::size_t tries = 0; due >= 1.0 && tries < 4 * members_.size(); ++tries) {
      const std::uint64_t before = sent_;
      send_line(members_[next++ % members_.size()]);
      due -= static_cast<double>(sent_ - before);
    }
    due = std::min(due, 1000.0);  // what a stall put off is not made up for without end
  }
}

void CommandCrowd::come(Member& member) const {
  const sockaddr_in address = loopback(options_.port);
  member = {socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0), false, 0};
  if (connect(member.socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 &&
      errno != EINPROGRESS) {
    leave(member.socket);
  }
}

void CommandCrowd::send_line(Member& member) {
  if (!member.up || options_.line.empty()) {
    return;
  }
  const std::size_t from = member.owed == 0 ? 0 : options_.line.size() - member.owed;
  const ssize_t length =
      send(member.socket, options_.line.data() + from, options_.line.size() - from, MSG_NOSIGNAL);
  if (length > 0) {
    member.owed = options_.line.size() - from - static_cast<std::size_t>(length);
    sent_ += member.owed == 0 ? 1U : 0U;
  }
}

// Takes what the boat says, and notices when it has ended the session.
void CommandCrowd::hear(Member& member) {
  std::array<char, 4096> part{};
  pollfd look{member.socket, POLLIN | POLLOUT, 0};
  if (member.socket < 0 || poll(&look, 1, 0) <= 0) {
    return;
  }
  if (!member.up && (look.revents & POLLOUT) != 0) {
    member.up = true;
    ++connected_;
  }
  if ((look.revents & (POLLIN | POLLERR | POLLHUP)) == 0) {
    return;
  }
  const ssize_t length = recv(member.socket, part.data(), part.size(), 0);
  if (length > 0) {
    answered_ += static_cast<std::uint64_t>(std::count(part.begin(), part.begin() + length, '\n'));
  } else if (length == 0 || errno != EAGAIN) {
    leave(member.socket);
    member.up = false;
  }
}

}  // namespace lodesman::testing
