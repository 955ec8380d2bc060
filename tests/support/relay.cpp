// SPDX-License-Identifier: Apache-2.0
#include "tests/support/relay.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace lodesman::testing {
namespace {

constexpr int kPoll_ms = 20;

[[nodiscard]] sockaddr_in address_of(const std::string& host, std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  if (inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) {
    throw std::runtime_error(host + " is no IPv4 address");
  }
  return address;
}

[[nodiscard]] bool is_ready(int socket) {
  pollfd waiting{socket, POLLIN, 0};
  return poll(&waiting, 1, kPoll_ms) > 0;
}

void send_all(int socket, const std::string& text) {
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t more = send(socket, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (more <= 0) {
      return;
    }
    sent += static_cast<std::size_t>(more);
  }
}

}  // namespace

Relay::Relay(const std::string& host, std::uint16_t boat_port, Change change)
    : host_{host}, boat_port_{boat_port}, change_{std::move(change)} {
  sockaddr_in address = address_of(host, 0);
  socklen_t size = sizeof address;
  listener_ = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 ||
      listen(listener_, 16) != 0 ||
      getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::runtime_error("the relay cannot listen on " + host);
  }
  port_ = ntohs(address.sin_port);
  thread_ = std::thread{[this] { serve(); }};
}

Relay::~Relay() {
  stop_ = true;
  thread_.join();
  close(listener_);
}

std::string Relay::heard(RelayWay way) const {
  const std::lock_guard lock{mutex_};
  return way == RelayWay::kToBoat ? to_boat_ : to_client_;
}

// One client after the other.
void Relay::serve() {
  while (!stop_) {
    if (is_ready(listener_)) {
      const int client = accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
      hand_on(client);
      close(client);
    }
  }
}

void Relay::hand_on(int client) {
  const int boat = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const sockaddr_in address = address_of(host_, boat_port_);
  bool up = connect(boat, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  std::array<std::string, 2> begun;  // each way, what has no line feed yet
  while (up && !stop_) {
    std::array<pollfd, 2> ends{pollfd{client, POLLIN, 0}, pollfd{boat, POLLIN, 0}};
    if (silent_ || poll(ends.data(), ends.size(), kPoll_ms) <= 0) {
      continue;
    }
    for (std::size_t i = 0; i < ends.size() && up; ++i) {
      if (ends.at(i).revents == 0) {
        continue;
      }
      std::array<char, 4096> bytes{};
      const ssize_t count = recv(ends.at(i).fd, bytes.data(), bytes.size(), 0);
      up = count > 0;
      const RelayWay way = i == 0 ? RelayWay::kToBoat : RelayWay::kToClient;
      const std::string text{bytes.data(), up ? static_cast<std::size_t>(count) : 0U};
      {
        const std::lock_guard lock{mutex_};
        (way == RelayWay::kToBoat ? to_boat_ : to_client_) += text;
      }
      begun.at(i) += text;
      for (std::size_t end = begun.at(i).find('\n'); end != std::string::npos;
           end = begun.at(i).find('\n')) {
        const std::string line = begun.at(i).substr(0, end + 1);
        begun.at(i).erase(0, end + 1);
        if (!silent_) {
          send_all(i == 0 ? boat : client, change_(way, line));
        }
      }
    }
  }
  close(boat);
}

}  // namespace lodesman::testing
