// SPDX-License-Identifier: Apache-2.0
// A client of the console that says what bytes it likes: HTTP and WebSocket by hand over a plain
// socket, so that nothing of the server's own library keeps it from being wrong.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>

#include "tests/support/catch.h"

namespace lodesman::testing {

struct RawReply {
  int status = 0;  // 0: none came
  std::string head;
  std::string body;

  [[nodiscard]] std::string header(const std::string& name) const {
    const std::size_t at = head.find("\r\n" + name + ": ");
    if (at == std::string::npos) {
      return {};
    }
    const std::size_t from = at + name.size() + 4;
    return head.substr(from, head.find("\r\n", from) - from);
  }
};

struct RawFrame {
  int opcode = -1;  // -1: none came
  std::string payload;
};

class RawViewer {
 public:
  static constexpr int kPatience_ms = 20000;  // whoever waits longer has lost something

  explicit RawViewer(std::uint16_t port, int receive_buffer = 0) {
    socket_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE(socket_ >= 0);
    if (receive_buffer > 0) {
      setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    REQUIRE(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    host = "127.0.0.1:" + std::to_string(port);
  }
  RawViewer(const RawViewer&) = delete;
  RawViewer& operator=(const RawViewer&) = delete;
  RawViewer(RawViewer&& other) noexcept
      : host{other.host}, socket_{std::exchange(other.socket_, -1)}, had_{other.had_} {}
  ~RawViewer() {
    if (socket_ >= 0) {
      close(socket_);
    }
  }

  std::string host;

  // False where the other end has gone.
  bool say(const std::string& bytes) {
    std::size_t said = 0;
    while (said < bytes.size()) {
      const ssize_t sent = send(socket_, bytes.data() + said, bytes.size() - said, MSG_NOSIGNAL);
      if (sent <= 0) {
        return false;
      }
      said += static_cast<std::size_t>(sent);
    }
    return true;
  }

  // `headers`: more of them, each with its line end.
  RawReply ask(const std::string& method, const std::string& target,
               const std::string& headers = {}, const std::string& body = {}) {
    std::string text = method + " " + target + " HTTP/1.1\r\nHost: " + host + "\r\n" + headers;
    if (!body.empty()) {
      text += "Content-Type: application/json\r\nContent-Length: " + std::to_string(body.size()) +
              "\r\n";
    }
    say(text + "\r\n" + body);
    return hear_reply();
  }

  RawReply upgrade(const std::string& target, const std::string& headers = {},
                   const std::string& protocol = "foxglove.sdk.v1") {
    return ask("GET", target,
               "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                   (protocol.empty() ? "" : "Sec-WebSocket-Protocol: " + protocol + "\r\n") +
                   headers);
  }

  RawReply hear_reply() {
    RawReply reply;
    std::size_t end = std::string::npos;
    while ((end = had_.find("\r\n\r\n")) == std::string::npos) {
      if (!more()) {
        return reply;
      }
    }
    reply.head = had_.substr(0, end + 2);
    had_.erase(0, end + 4);
    reply.status = std::atoi(reply.head.substr(reply.head.find(' ') + 1, 3).c_str());
    const std::size_t length =
        static_cast<std::size_t>(std::atoi(reply.header("Content-Length").c_str()));
    while (had_.size() < length && more()) {
    }
    reply.body = had_.substr(0, length);
    had_.erase(0, length);
    return reply;
  }

  // Masked, as a client's are, by a mask of zeros.
  bool frame(int opcode, const std::string& payload) {
    std::string bytes{static_cast<char>(0x80 | opcode)};
    if (payload.size() < 126) {
      bytes += static_cast<char>(0x80 | payload.size());
    } else if (payload.size() < 65536) {
      bytes += static_cast<char>(0xfe);
      bytes += static_cast<char>(payload.size() >> 8U);
      bytes += static_cast<char>(payload.size() & 0xffU);
    } else {
      bytes += static_cast<char>(0xff);
      for (int shift = 56; shift >= 0; shift -= 8) {
        bytes += static_cast<char>(payload.size() >> static_cast<unsigned>(shift) & 0xffU);
      }
    }
    return say(bytes + std::string(4, '\0') + payload);
  }
  bool subscribe(unsigned id, unsigned channel) {
    return frame(1, R"({"op":"subscribe","subscriptions":[{"id":)" + std::to_string(id) +
                        R"(,"channelId":)" + std::to_string(channel) + "}]}");
  }
  bool call(std::uint32_t number, const std::string& json) {
    using namespace std::string_literals;
    std::string bytes = "\x02\x01\0\0\0"s;
    for (unsigned i = 0; i < 4; ++i) {
      bytes += static_cast<char>(number >> (8 * i) & 0xffU);
    }
    return frame(2, bytes + "\x04\0\0\0json"s + json);
  }

  // The next one; pings are answered by themselves.
  RawFrame hear() {
    for (;;) {
      RawFrame heard = next_frame();
      if (heard.opcode != 9) {
        return heard;
      }
      frame(10, heard.payload);
    }
  }
  // The next text or binary whose payload has that in it; none where the other end goes before.
  RawFrame hear_with(const std::string& part) {
    for (;;) {
      RawFrame heard = hear();
      if (heard.opcode < 0 || heard.opcode == 8 || heard.payload.find(part) != std::string::npos) {
        return heard;
      }
    }
  }
  // Whether the other end goes, whatever it says before.
  bool is_ended() {
    while (more()) {
      had_.clear();
    }
    return ended_;
  }

 private:
  // False where nothing comes any more.
  bool more() {
    pollfd wait{socket_, POLLIN, 0};
    if (poll(&wait, 1, kPatience_ms) <= 0) {
      return false;
    }
    char piece[65536];
    const ssize_t got = recv(socket_, piece, sizeof piece, 0);
    if (got <= 0) {
      ended_ = true;
      return false;
    }
    had_.append(piece, static_cast<std::size_t>(got));
    return true;
  }
  bool have(std::size_t bytes) {
    while (had_.size() < bytes) {
      if (!more()) {
        return false;
      }
    }
    return true;
  }
  RawFrame next_frame() {
    if (!have(2)) {
      return {};
    }
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(had_[i]); };
    std::size_t head = 2;
    std::uint64_t length = byte(1) & 0x7fU;
    if (length >= 126) {
      const std::size_t wide = length == 126 ? 2 : 8;
      if (!have(2 + wide)) {
        return {};
      }
      length = 0;
      for (std::size_t i = 0; i < wide; ++i) {
        length = length << 8U | byte(2 + i);
      }
      head += wide;
    }
    const int opcode = byte(0) & 0x0f;
    if (!have(head + static_cast<std::size_t>(length))) {
      return {};
    }
    RawFrame heard{opcode, had_.substr(head, static_cast<std::size_t>(length))};
    had_.erase(0, head + static_cast<std::size_t>(length));
    return heard;
  }

  int socket_ = -1;
  std::string had_;
  bool ended_ = false;
};

}  // namespace lodesman::testing
