// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/udp_socket.h"

#include <arpa/inet.h>
#include <netdb.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// Dropped at one call before it says that there is nothing: a flood of others holds nobody up.
constexpr int kMostForeign = 64;
// Errors that wait, taken at one call.
constexpr int kMostErrors = 16;
constexpr int kLeastBetweenRings_ms = 1;

[[noreturn]] void refuse(const std::string& what, int error) {
  throw StartupError(what + ": " + std::generic_category().message(error));
}

[[nodiscard]] in_addr address_of(const std::string& peer) {
  addrinfo hints{};
  hints.ai_family = AF_INET;
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  if (const int error = getaddrinfo(peer.c_str(), nullptr, &hints, &found); error != 0) {
    throw StartupError("\"" + peer + "\" is no address of a computer: " + gai_strerror(error));
  }
  // The first of those that there are.
  sockaddr_in address{};
  std::memcpy(&address, found->ai_addr, sizeof(address));
  freeaddrinfo(found);
  return address.sin_addr;
}

// The system calls want the address of any family.
[[nodiscard]] sockaddr* any(sockaddr_in& address) noexcept {
  return static_cast<sockaddr*>(static_cast<void*>(&address));
}

[[nodiscard]] std::uint16_t bind_to(int socket, std::uint16_t port) {
  sockaddr_in local{};
  local.sin_family = AF_INET;
  local.sin_addr.s_addr = htonl(INADDR_ANY);
  local.sin_port = htons(port);
  if (bind(socket, any(local), sizeof(local)) != 0) {
    refuse("UDP port " + std::to_string(port) + " of this computer cannot be had", errno);
  }
  socklen_t size = sizeof(local);
  if (getsockname(socket, any(local), &size) != 0) {
    refuse("the UDP socket has no name", errno);
  }
  return ntohs(local.sin_port);
}

// With rights as much as is asked for, else as much as the system's bound allows.
[[nodiscard]] int enlarge_buffers(int socket, int wanted_bytes) noexcept {
  if (setsockopt(socket, SOL_SOCKET, SO_RCVBUFFORCE, &wanted_bytes, sizeof(wanted_bytes)) != 0) {
    setsockopt(socket, SOL_SOCKET, SO_RCVBUF, &wanted_bytes, sizeof(wanted_bytes));
  }
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &wanted_bytes, sizeof(wanted_bytes));
  int granted_bytes = 0;
  socklen_t size = sizeof(granted_bytes);
  getsockopt(socket, SOL_SOCKET, SO_RCVBUF, &granted_bytes, &size);
  return granted_bytes;
}

// An error that waits wakes whoever polls, and takes room that datagrams need, until it is read.
void drop_errors(int socket) noexcept {
  std::array<std::uint8_t, 1> byte{};
  for (int i = 0; i < kMostErrors; ++i) {
    if (recv(socket, byte.data(), byte.size(), MSG_ERRQUEUE | MSG_DONTWAIT | MSG_TRUNC) < 0) {
      return;
    }
  }
}

}  // namespace

UdpSocket::UdpSocket(const UdpOptions& options, std::function<void()> on_datagram)
    : on_datagram_{std::move(on_datagram)},
      socket_{socket(AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)},
      any_port_{options.peer_port == 0} {
  if (!socket_.is_open()) {
    refuse("no UDP socket can be had", errno);
  }
  peer_.sin_family = AF_INET;
  peer_.sin_addr = address_of(options.peer);
  peer_.sin_port = htons(options.peer_port);
  receive_buffer_bytes_ = enlarge_buffers(socket_.value(), kWantedBuffer_bytes);
  const int on = 1;
  setsockopt(socket_.value(), IPPROTO_IP, IP_RECVERR, &on, sizeof(on));
  local_port_ = bind_to(socket_.value(), options.local_port);
  if (on_datagram_) {
    bell_ = FileDescriptor{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)};
    if (!bell_.is_open()) {
      refuse("no bell for the UDP socket can be had", errno);
    }
    try {
      attendant_ = std::thread{[this] { attend(); }};
    } catch (const std::system_error& error) {
      throw StartupError(std::string{"no thread for the UDP socket can be had: "} + error.what());
    }
  }
}

UdpSocket::~UdpSocket() {
  if (attendant_.joinable()) {
    eventfd_write(bell_.value(), 1);
    attendant_.join();
  }
}

DatagramSocket::Received UdpSocket::receive(std::span<std::uint8_t> buffer) noexcept {
  Received received;
  for (int i = 0; i < kMostForeign; ++i) {
    switch (receive_one(buffer, received)) {
      case Arrival::kOurs: fault_ = DeviceFault::kNone; return received;
      case Arrival::kForeign: ++foreign_; break;
      case Arrival::kNone: return {};
    }
  }
  return {};
}

UdpSocket::Arrival UdpSocket::receive_one(std::span<std::uint8_t> buffer,
                                          Received& received) noexcept {
  sockaddr_in from{};
  iovec piece{buffer.data(), buffer.size()};
  msghdr message{};
  message.msg_name = &from;
  message.msg_namelen = sizeof(from);
  message.msg_iov = &piece;
  message.msg_iovlen = 1;
  const ssize_t size = recvmsg(socket_.value(), &message, MSG_DONTWAIT);
  if (size < 0) {
    note_error(errno);
    return Arrival::kNone;
  }
  if (!is_of_peer(from)) {
    return Arrival::kForeign;
  }
  peer_.sin_port = from.sin_port;
  received = {true, (message.msg_flags & MSG_TRUNC) != 0, static_cast<std::size_t>(size)};
  return Arrival::kOurs;
}

bool UdpSocket::is_of_peer(const sockaddr_in& from) const noexcept {
  return from.sin_family == AF_INET && from.sin_addr.s_addr == peer_.sin_addr.s_addr &&
         (any_port_ || from.sin_port == peer_.sin_port);
}

bool UdpSocket::reply(std::span<const std::uint8_t> bytes) noexcept {
  if (peer_.sin_port == 0) {
    return false;
  }
  sockaddr_in to = peer_;
  const ssize_t sent = sendto(socket_.value(), bytes.data(), bytes.size(),
                              MSG_DONTWAIT | MSG_NOSIGNAL, any(to), sizeof(to));
  if (sent < 0) {
    note_error(errno);
  }
  return sent == static_cast<ssize_t>(bytes.size());
}

// An error of what was sent before is told at the next call, whichever that is.
void UdpSocket::note_error(int error) noexcept {
  switch (error) {
    case EAGAIN:
    case EINTR:
    case ENOBUFS:
    case EMSGSIZE: return;
    case ECONNREFUSED: fault_ = DeviceFault::kNobodyListens; break;
    default: fault_ = DeviceFault::kNoWay; break;
  }
  drop_errors(socket_.value());
}

// Rings at each arrival, whether or not the one before was taken: a task that does not come for its
// datagrams is not rung for again and again.
void UdpSocket::attend() noexcept {
  const FileDescriptor arrivals{epoll_create1(EPOLL_CLOEXEC)};
  epoll_event on_arrival{};
  on_arrival.events = EPOLLIN | EPOLLET;
  on_arrival.data.fd = socket_.value();
  epoll_event at_end{};
  at_end.events = EPOLLIN;
  at_end.data.fd = bell_.value();
  if (epoll_ctl(arrivals.value(), EPOLL_CTL_ADD, socket_.value(), &on_arrival) != 0 ||
      epoll_ctl(arrivals.value(), EPOLL_CTL_ADD, bell_.value(), &at_end) != 0) {
    return;  // its task still polls
  }
  std::array<epoll_event, 2> events{};
  while (true) {
    const int count = epoll_wait(arrivals.value(), events.data(), events.size(), -1);
    if (count < 0 && errno != EINTR) {
      return;
    }
    for (int i = 0; i < count; ++i) {
      if (events[static_cast<std::size_t>(i)].data.fd == bell_.value()) {
        return;
      }
      on_datagram_();
    }
    pollfd end{bell_.value(), POLLIN, 0};
    poll(&end, 1, kLeastBetweenRings_ms);
  }
}

}  // namespace lodesman
