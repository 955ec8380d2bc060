// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <thread>
#include <tuple>
#include <utility>  // Boost 1.74 uses std::exchange without including it

#include <boost/asio.hpp>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr std::size_t kMaxLine = 64 * 1024;  // [bytes] a longer command ends its session
constexpr int kAcceptsPerTurn = 64;          // before the sessions have their turn
constexpr std::chrono::milliseconds kAnswerPeriod{5};
constexpr std::chrono::milliseconds kIdleLookPeriod{100};
constexpr std::chrono::milliseconds kAcceptPause{10};
constexpr std::chrono::milliseconds kFarewellLimit{300};

// In the order in which places are given up.
enum class Standing { kStranger, kKnown, kAwaitsAnswer, kAwaitsAbort };

struct Session {
  explicit Session(tcp::socket socket_in)
      : socket{std::move(socket_in)}, timer{socket.get_executor()} {}

  void end() noexcept {
    error_code ignored;
    // At once: nothing of it lingers in the kernel.
    socket.set_option(asio::socket_base::linger{true, 0}, ignored);
    socket.close(ignored);
    timer.cancel();
  }

  tcp::socket socket;
  asio::steady_timer timer;
  std::uint64_t id = 0;
  asio::steady_timer::time_point heard = asio::steady_timer::clock_type::now();
  Standing standing = Standing::kStranger;
};

[[nodiscard]] bool is_stranger(const std::shared_ptr<Session>& session) noexcept {
  return session->standing == Standing::kStranger;
}

// A descriptor in reserve, given up to let an operator in when the process has no more.
class SpareDescriptor {
 public:
  SpareDescriptor() noexcept { take(); }
  SpareDescriptor(const SpareDescriptor&) = delete;
  SpareDescriptor& operator=(const SpareDescriptor&) = delete;
  ~SpareDescriptor() { give(); }

  void take() noexcept {
    if (descriptor_ < 0) {
      descriptor_ = open("/dev/null", O_RDONLY | O_CLOEXEC);
    }
  }
  // Whether there was one to give.
  bool give() noexcept { return descriptor_ >= 0 && close(std::exchange(descriptor_, -1)) == 0; }

 private:
  int descriptor_ = -1;
};

asio::awaitable<std::string> reply_of(Session& session, const Answer& answer) {
  for (;;) {
    if (auto reply = answer(); reply) {
      co_return *std::move(reply);
    }
    session.timer.expires_after(kAnswerPeriod);
    co_await session.timer.async_wait(asio::use_awaitable);
  }
}

asio::awaitable<void> send_line(Session& session, std::string line) {
  line += '\n';
  co_await asio::async_write(session.socket, asio::buffer(line), asio::use_awaitable);
}

}  // namespace

struct CommandSocket::Impl {
  using Sessions = std::list<std::shared_ptr<Session>>;

  Impl(const CommandSocketOptions& options_in, CommandHandler handler_in,
       CommandSocketEvents events_in)
      : options{options_in}, handler{std::move(handler_in)}, events{std::move(events_in)} {}

  // Line by line: a session that sends many at once waits for the others after each.
  asio::awaitable<void> converse(Session& session) {
    std::string buffer;
    for (;;) {
      const std::size_t length = co_await asio::async_read_until(
          session.socket, asio::dynamic_buffer(buffer, kMaxLine), '\n', asio::use_awaitable);
      session.heard = asio::steady_timer::clock_type::now();
      CommandLine line = read_command_line(buffer.substr(0, length), options.tokens);
      buffer.erase(0, length);
      if (!line.refusal.empty()) {
        co_await send_line(session, line.refusal);
        co_return;
      }
      session.standing =
          stops_the_boat(line.request.command) ? Standing::kAwaitsAbort : Standing::kAwaitsAnswer;
      line.request.session = session.id;
      const Answer answer = handler(line.request);
      std::string reply = co_await reply_of(session, answer);
      session.standing = Standing::kKnown;
      co_await send_line(session, std::move(reply));
    }
  }

  asio::awaitable<void> serve(std::shared_ptr<Session> session) {
    try {
      co_await converse(*session);
    } catch (const std::exception&) {
      // The other side is gone, its line is too long, or it gave up its place: this session ends.
    }
    if (events.ended && session->standing != Standing::kStranger) {
      events.ended(session->id);
    }
    sessions.remove(session);
    spare.take();
  }

  void put_out(Sessions::iterator session) {
    (*session)->end();
    sessions.erase(session);
  }

  // Who has been silent longest: of the strangers where they fill their places, else of those that
  // showed the token. A stranger is thus given the time to speak that it takes as many others to
  // come. Where all wait for an answer, the last to ask: the first is about to have its own.
  [[nodiscard]] Sessions::iterator whose_place_to_give() {
    const auto strangers = std::count_if(sessions.begin(), sessions.end(), is_stranger);
    const bool of_strangers = static_cast<std::size_t>(strangers) >= kMaxStrangers;
    const auto rank = [of_strangers](const std::shared_ptr<Session>& session) {
      const auto heard = session->heard.time_since_epoch();
      const bool waits = session->standing >= Standing::kAwaitsAnswer;
      return std::make_tuple(session->standing == Standing::kAwaitsAbort,
                             is_stranger(session) != of_strangers, session->standing,
                             waits ? -heard : heard);
    };
    return std::min_element(sessions.begin(), sessions.end(),
                            [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  }

  // Whether a session gave up its place.
  [[nodiscard]] bool make_room() {
    const auto least = whose_place_to_give();
    if (least == sessions.end() || (*least)->standing == Standing::kAwaitsAbort) {
      return false;
    }
    put_out(least);
    return true;
  }

  void admit(tcp::socket socket) {
    if (sessions.size() < kMaxSessions || make_room()) {
      sessions.push_back(std::make_shared<Session>(std::move(socket)));
      sessions.back()->id = ++session_count;
      asio::co_spawn(context, serve(sessions.back()), asio::detached);
    }
  }

  // Without a descriptor left, accept() fails whether somebody waits or not.
  [[nodiscard]] bool somebody_waits() {
    pollfd listening{acceptor.native_handle(), POLLIN, 0};
    return poll(&listening, 1, 0) > 0;
  }

  // Takes in who waits. False when that fails and nothing could be done about it.
  [[nodiscard]] bool accept_some() {
    for (int i = 0; i < kAcceptsPerTurn; ++i) {
      error_code error;
      tcp::socket socket{context};
      acceptor.accept(socket, error);
      if (error == asio::error::would_block || (error && !somebody_waits())) {
        return true;
      }
      if (!error) {
        admit(std::move(socket));
      } else if (!make_room() && !spare.give()) {
        return false;
      }
    }
    return true;
  }

  asio::awaitable<void> listen() {
    asio::steady_timer pause{context};
    for (;;) {
      bool ok = false;
      try {
        co_await acceptor.async_wait(tcp::acceptor::wait_read, asio::use_awaitable);
        ok = accept_some();
      } catch (const std::exception&) {
        // Out of something: a moment later there may be more.
      }
      error_code ignored;
      pause.expires_after(ok ? std::chrono::milliseconds{0} : kAcceptPause);
      co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
    }
  }

  asio::awaitable<void> every(Duration period, std::function<void()> act) {
    asio::steady_timer timer{context};
    for (;;) {
      error_code ignored;
      timer.expires_after(period);
      co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
      act();
    }
  }

  void put_out_the_silent() {
    const auto now = asio::steady_timer::clock_type::now();
    for (auto next = sessions.begin(); next != sessions.end();) {
      const auto session = next++;
      const Duration limit = (*session)->standing == Standing::kStranger
                                 ? options.stranger_idle_limit
                                 : options.idle_limit;
      if (now - (*session)->heard > limit) {
        put_out(session);
      }
    }
    spare.take();
  }

  [[nodiscard]] bool somebody_awaits_an_answer() const {
    return std::any_of(sessions.begin(), sessions.end(), [](const auto& session) {
      return session->standing >= Standing::kAwaitsAnswer;
    });
  }

  // An abort is often what ends the program: whoever gave it is told what came of it.
  asio::awaitable<void> say_farewell() {
    try {
      acceptor.close();
      const auto limit = asio::steady_timer::clock_type::now() + kFarewellLimit;
      asio::steady_timer timer{context};
      while (somebody_awaits_an_answer() && asio::steady_timer::clock_type::now() < limit) {
        timer.expires_after(kAnswerPeriod);
        co_await timer.async_wait(asio::use_awaitable);
      }
    } catch (const std::exception&) {
      // Out of something: without a farewell, then.
    }
    context.stop();
  }

  // Throws StartupError.
  void open() {
    error_code error;
    const auto address = asio::ip::make_address(options.address, error);
    if (error) {
      throw StartupError("command_socket.address: \"" + options.address + "\" is no IP address");
    }
    if (!address.is_loopback()) {
      throw StartupError("command_socket.address: " + options.address +
                         " is not loopback, and the token would cross the network in the clear; "
                         "use loopback and a tunnel");
    }
    if (options.tokens.command.empty()) {
      throw StartupError("command_socket.token_file: a token is required");
    }
    const tcp::endpoint endpoint{address, options.port};
    acceptor.open(endpoint.protocol(), error);
    if (!error) {
      acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
      acceptor.bind(endpoint, error);
    }
    if (!error) {
      acceptor.listen(asio::socket_base::max_listen_connections, error);
    }
    if (!error) {
      acceptor.non_blocking(true, error);
    }
    if (error) {
      throw StartupError("command_socket.port: cannot listen on port " +
                         std::to_string(options.port) + ": " + error.message());
    }
  }

  // An exception that leaves a handler ends run(), not the socket.
  void run() {
    while (!context.stopped()) {
      try {
        context.run();
      } catch (const std::exception&) {
        continue;
      }
    }
  }

  CommandSocketOptions options;
  CommandHandler handler;
  CommandSocketEvents events;
  std::uint64_t session_count = 0;
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  Sessions sessions;
  SpareDescriptor spare;
  std::jthread thread;
};

CommandSocket::CommandSocket(const CommandSocketOptions& options, CommandHandler handler,
                             CommandSocketEvents events)
    : impl_{std::make_unique<Impl>(options, std::move(handler), std::move(events))} {
  impl_->open();
  asio::co_spawn(impl_->context, impl_->listen(), asio::detached);
  asio::co_spawn(
      impl_->context,
      impl_->every(kIdleLookPeriod, [impl = impl_.get()] { impl->put_out_the_silent(); }),
      asio::detached);
  if (impl_->events.look) {
    asio::co_spawn(impl_->context, impl_->every(kLookPeriod, impl_->events.look), asio::detached);
  }
  impl_->thread = std::jthread{[impl = impl_.get()] { impl->run(); }};
}

CommandSocket::~CommandSocket() {
  asio::co_spawn(impl_->context, impl_->say_farewell(), asio::detached);
  impl_->thread.join();
}

std::uint16_t CommandSocket::port() const noexcept {
  error_code error;
  return impl_->acceptor.local_endpoint(error).port();
}

}  // namespace lodesman
