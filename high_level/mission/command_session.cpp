// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_session.h"

#include <boost/asio.hpp>

namespace lodesman {
namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::size_t kMaxLine = 64 * 1024;  // [bytes] a longer one ends its session
constexpr std::size_t kMaxFarLine = 1024;  // [bytes] beyond loopback, before it has proved a token

}  // namespace

Time socket_time() noexcept {
  return Time{asio::steady_timer::clock_type::now().time_since_epoch()};
}

CommandSession::CommandSession(tcp::socket socket_in, const std::string& address_in)
    : socket{std::move(socket_in)}, timer{socket.get_executor()}, address{address_in} {
  place.network = network_of(address);
  place.heard = socket_time();
}

void CommandSession::end() noexcept {
  error_code ignored;
  // At once: nothing of it lingers in the kernel.
  socket.set_option(asio::socket_base::linger{true, 0}, ignored);
  socket.close(ignored);
  timer.cancel();
}

asio::awaitable<void> wait(CommandSession& session, Duration pause) {
  session.timer.expires_after(pause);
  co_await session.timer.async_wait(asio::use_awaitable);
}

asio::awaitable<std::string> next_line(CommandSession& session) {
  const std::size_t limit = session.is_far() && session.is_stranger() ? kMaxFarLine : kMaxLine;
  const std::size_t length = co_await asio::async_read_until(
      session.socket, asio::dynamic_buffer(session.buffer, limit), '\n', asio::use_awaitable);
  session.place.heard = socket_time();
  std::string line = session.buffer.substr(0, length - 1);
  session.buffer.erase(0, length);
  co_return line;
}

asio::awaitable<void> send_line(CommandSession& session, std::string line) {
  if (session.proved) {
    line = session.proved->lines.seal(line);
  }
  line += '\n';
  co_await asio::async_write(session.socket, asio::buffer(line), asio::use_awaitable);
}

}  // namespace lodesman
