// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_socket.h"

#include <thread>
#include <utility>  // Boost 1.74 uses std::exchange without including it

#include <boost/asio.hpp>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace asio = boost::asio;
using asio::ip::tcp;

namespace {

constexpr std::size_t kMaxLine = 4096;  // [bytes] a longer command ends its connection
constexpr int kMaxSessions = 16;

}  // namespace

struct CommandSocket::Impl {
  Impl(const CommandSocketOptions& options_in, CommandHandler handler_in)
      : options{options_in}, handler{std::move(handler_in)} {}

  asio::awaitable<void> serve(tcp::socket socket) {
    ++sessions;
    std::string buffer;
    try {
      for (;;) {
        const std::size_t length = co_await asio::async_read_until(
            socket, asio::dynamic_buffer(buffer, kMaxLine), '\n', asio::use_awaitable);
        const std::string reply = reply_to(buffer.substr(0, length), options.token, handler) + "\n";
        buffer.erase(0, length);
        co_await asio::async_write(socket, asio::buffer(reply), asio::use_awaitable);
      }
    } catch (const boost::system::system_error&) {
      // The other side is gone, or its line is too long: this session ends.
    }
    --sessions;
  }

  asio::awaitable<void> listen() {
    for (;;) {
      tcp::socket socket = co_await acceptor.async_accept(asio::use_awaitable);
      if (sessions < kMaxSessions) {
        asio::co_spawn(context, serve(std::move(socket)), asio::detached);
      }
    }
  }

  CommandSocketOptions options;
  CommandHandler handler;
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  int sessions = 0;
  std::jthread thread;
};

CommandSocket::CommandSocket(const CommandSocketOptions& options, CommandHandler handler)
    : impl_{std::make_unique<Impl>(options, std::move(handler))} {
  boost::system::error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) {
    throw StartupError("command_socket.address: \"" + options.address + "\" is no IP address");
  }
  if (!address.is_loopback() && options.token.empty()) {
    throw StartupError("command_socket.address: " + options.address +
                       " is not loopback, so a token is required");
  }
  const tcp::endpoint endpoint{address, options.port};
  impl_->acceptor.open(endpoint.protocol(), error);
  if (!error) {
    impl_->acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
    impl_->acceptor.bind(endpoint, error);
  }
  if (!error) {
    impl_->acceptor.listen(asio::socket_base::max_listen_connections, error);
  }
  if (error) {
    throw StartupError("command_socket.port: cannot listen on port " +
                       std::to_string(options.port) + ": " + error.message());
  }
  asio::co_spawn(impl_->context, impl_->listen(), asio::detached);
  impl_->thread = std::jthread{[impl = impl_.get()] { impl->context.run(); }};
}

CommandSocket::~CommandSocket() {
  impl_->context.stop();
  impl_->thread.join();
}

std::uint16_t CommandSocket::port() const noexcept {
  boost::system::error_code error;
  return impl_->acceptor.local_endpoint(error).port();
}

}  // namespace lodesman
