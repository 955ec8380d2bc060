// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/tcp_port.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>

namespace lodesman {
namespace {

struct Found {
  addrinfo* first = nullptr;
  Found() = default;
  Found(const Found&) = delete;
  Found& operator=(const Found&) = delete;
  ~Found() {
    if (first != nullptr) {
      freeaddrinfo(first);
    }
  }
};

// Without brackets round the host.
void look_up(const std::string& place, Found& found) {
  const std::size_t colon = place.rfind(':');
  if (colon == std::string::npos || colon == 0) {
    return;
  }
  std::string host = place.substr(0, colon);
  if (host.front() == '[' && host.back() == ']') {
    host = host.substr(1, host.size() - 2);
  }
  addrinfo wanted{};
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  wanted.ai_flags = AI_NUMERICSERV;
  if (getaddrinfo(host.c_str(), place.c_str() + colon + 1, &wanted, &found.first) != 0) {
    found.first = nullptr;
  }
}

// Not open where it does not answer in time.
[[nodiscard]] FileDescriptor connected_to(const addrinfo& address) noexcept {
  FileDescriptor made{socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC,
                             address.ai_protocol)};
  if (!made.is_open()) {
    return {};
  }
  if (connect(made.value(), address.ai_addr, address.ai_addrlen) == 0) {
    return made;
  }
  pollfd waited{made.value(), POLLOUT, 0};
  if (errno != EINPROGRESS || poll(&waited, 1, TcpPort::kConnectLimit_ms) <= 0) {
    return {};
  }
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(made.value(), SOL_SOCKET, SO_ERROR, &error, &size);
  return error == 0 ? std::move(made) : FileDescriptor{};
}

}  // namespace

OpenedPort TcpPort::open(const std::string& place) {
  Found found;
  look_up(place, found);
  for (const addrinfo* one = found.first; one != nullptr; one = one->ai_next) {
    if (FileDescriptor made = connected_to(*one); made.is_open()) {
      const int on = 1;
      setsockopt(made.value(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return {std::make_unique<TcpPort>(std::move(made)), DeviceFault::kNone};
    }
  }
  return {nullptr, DeviceFault::kNoService};
}

std::size_t TcpPort::read(std::span<std::uint8_t> into) noexcept {
  return count_of(recv(descriptor_.value(), into.data(), into.size(), MSG_DONTWAIT));
}

std::size_t TcpPort::write(std::span<const std::uint8_t> bytes) noexcept {
  return count_of(
      send(descriptor_.value(), bytes.data(), bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
}

bool TcpPort::is_gone() const noexcept {
  char byte = 0;
  const ssize_t there = recv(descriptor_.value(), &byte, 1, MSG_DONTWAIT | MSG_PEEK);
  return there == 0 || (there < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR);
}

}  // namespace lodesman
