// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/command_socket.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <list>
#include <optional>
#include <thread>
#include <utility>  // Boost 1.74 uses std::exchange without including it
#include <vector>

#include <boost/asio.hpp>

#include "high_level/mission/command_session.h"
#include "high_level/mission/handshake.h"
#include "high_level/mission/network.h"
#include "high_level/mission/proof_limit.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

constexpr int kAcceptsPerTurn = 64;  // before the sessions have their turn
constexpr std::chrono::milliseconds kAnswerPeriod{5};
constexpr std::chrono::milliseconds kIdleLookPeriod{100};
constexpr std::chrono::milliseconds kAcceptPause{10};
constexpr std::chrono::milliseconds kFarewellLimit{300};

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

asio::awaitable<std::string> reply_of(CommandSession& session, const Answer& answer) {
  for (;;) {
    if (auto reply = answer(); reply) {
      co_return *std::move(reply);
    }
    co_await wait(session, kAnswerPeriod);
  }
}

}  // namespace

struct CommandSocket::Impl {
  using Sessions = std::list<std::shared_ptr<CommandSession>>;

  Impl(const CommandSocketOptions& options_in, CommandHandler handler_in,
       CommandSocketEvents events_in)
      : options{options_in}, handler{std::move(handler_in)}, events{std::move(events_in)} {}

  // On loopback the tokens of this run count too.
  [[nodiscard]] std::vector<CommandTokens> tokens_for(const CommandSession& session) const {
    return session.is_far() ? std::vector{options.lasting_tokens}
                            : std::vector{options.tokens, options.lasting_tokens};
  }

  void count_failure(const CommandSession& session) {
    limit.failed(session.place.network, socket_time());
    if (events.refused && session.is_far()) {
      events.refused(session.address);
    }
  }

  // The boat speaks first. Whether a token was proved: if not, this session ends.
  asio::awaitable<bool> shake_hands(CommandSession& session) {
    const BoatHandshake handshake{random_digest()};
    co_await send_line(session, handshake.challenge());
    std::string answer = co_await next_line(session);
    if (session.is_far() && is_handshake_request(answer)) {  // which crossed the challenge
      answer = co_await next_line(session);
    }
    if (const Duration pause = limit.pause(session.place.network, socket_time());
        pause > Duration{}) {
      co_await wait(session, pause);
    }
    BoatHandshake::Verdict verdict = handshake.judge(answer, tokens_for(session));
    const bool proved = verdict.scope != Scope::kNone;
    // Before it is told: whoever hangs up on the verdict has guessed all the same.
    if (!proved) {
      count_failure(session);
    }
    co_await send_line(session, std::move(verdict.reply));
    if (!proved) {
      co_return false;
    }
    session.proved = {verdict.scope, {verdict.keys, SessionEnd::kBoat}};
    session.place.standing = Standing::kKnown;
    co_return true;
  }

  [[nodiscard]] CommandLine understood(CommandSession& session, const std::string& text) const {
    if (session.proved) {
      const auto opened = session.proved->lines.open(text);
      return opened ? read_command_line(*opened, session.proved->scope)
                    : CommandLine{{},
                                  refusal("this is not what was sealed next: altered, "
                                          "repeated, out of order or in the clear")};
    }
    CommandLine line;
    for (const CommandTokens& tokens : tokens_for(session)) {
      line = read_command_line(text, tokens);
      if (line.refusal.empty()) {
        break;
      }
    }
    return line;
  }

  // Line by line: a session that sends many at once waits for the others after each.
  asio::awaitable<void> converse(CommandSession& session) {
    bool welcome = true;
    if (session.is_far()) {
      welcome = co_await shake_hands(session);
    }
    for (bool first = !session.is_far(); welcome; first = false) {
      const std::string text = co_await next_line(session);
      if (first && is_handshake_request(text)) {
        welcome = co_await shake_hands(session);
        continue;
      }
      CommandLine line = understood(session, text);
      if (!line.refusal.empty()) {
        co_await send_line(session, line.refusal);
        co_return;
      }
      session.place.standing =
          stops_the_boat(line.request.command) ? Standing::kAwaitsAbort : Standing::kAwaitsAnswer;
      line.request.session = session.id;
      const Answer answer = handler(line.request);
      std::string reply = co_await reply_of(session, answer);
      session.place.standing = Standing::kKnown;
      co_await send_line(session, std::move(reply));
    }
  }

  asio::awaitable<void> serve(std::shared_ptr<CommandSession> session) {
    try {
      co_await converse(*session);
    } catch (const std::exception&) {
      // The other side is gone, its line is too long, or it gave up its place: this session ends.
    }
    if (events.ended && !session->is_stranger()) {
      events.ended(session->id);
    }
    sessions.remove(session);
    spare.take();
  }

  void put_out(Sessions::iterator session) {
    (*session)->end();
    sessions.erase(session);
  }

  // Whether a session gave up its place.
  [[nodiscard]] bool make_room() {
    std::vector<SessionPlace> places;
    places.reserve(sessions.size());
    for (const auto& session : sessions) {
      places.push_back(session->place);
    }
    const std::size_t least = whose_place_to_give(places);
    if (least == places.size()) {
      return false;
    }
    put_out(std::next(sessions.begin(), static_cast<std::ptrdiff_t>(least)));
    return true;
  }

  void admit(tcp::socket socket) {
    error_code error;
    const tcp::endpoint client = socket.remote_endpoint(error);
    if (!error && (sessions.size() < kMaxSessions || make_room())) {
      const std::string address = client.address().to_string();
      sessions.push_back(std::make_shared<CommandSession>(std::move(socket), address));
      sessions.back()->id = ++session_count;
      asio::co_spawn(context, serve(sessions.back()), asio::detached);
    }
  }

  // Without a descriptor left, accept() fails whether somebody waits or not.
  [[nodiscard]] static bool somebody_waits(tcp::acceptor& acceptor) {
    pollfd listening{acceptor.native_handle(), POLLIN, 0};
    return poll(&listening, 1, 0) > 0;
  }

  // Takes in who waits. False when that fails and nothing could be done about it.
  [[nodiscard]] bool accept_some(tcp::acceptor& acceptor) {
    for (int i = 0; i < kAcceptsPerTurn; ++i) {
      error_code error;
      tcp::socket socket{context};
      acceptor.accept(socket, error);
      if (error == asio::error::would_block || (error && !somebody_waits(acceptor))) {
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

  asio::awaitable<void> listen(tcp::acceptor& acceptor) {
    asio::steady_timer pause{context};
    for (;;) {
      bool ok = false;
      try {
        co_await acceptor.async_wait(tcp::acceptor::wait_read, asio::use_awaitable);
        ok = accept_some(acceptor);
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
    for (auto next = sessions.begin(); next != sessions.end();) {
      const auto session = next++;
      const Duration known_limit =
          (*session)->is_far() ? options.far_idle_limit : options.idle_limit;
      const Duration idle_limit =
          (*session)->is_stranger() ? options.stranger_idle_limit : known_limit;
      if (socket_time() - (*session)->place.heard > idle_limit) {
        put_out(session);
      }
    }
    spare.take();
  }

  [[nodiscard]] bool somebody_awaits_an_answer() const {
    return std::any_of(sessions.begin(), sessions.end(), [](const auto& session) {
      return session->place.standing >= Standing::kAwaitsAnswer;
    });
  }

  // An abort is often what ends the program: whoever gave it is told what came of it.
  asio::awaitable<void> say_farewell() {
    try {
      for (tcp::acceptor& acceptor : acceptors) {
        acceptor.close();
      }
      const Time end = socket_time() + kFarewellLimit;
      asio::steady_timer timer{context};
      while (somebody_awaits_an_answer() && socket_time() < end) {
        timer.expires_after(kAnswerPeriod);
        co_await timer.async_wait(asio::use_awaitable);
      }
    } catch (const std::exception&) {
      // Out of something: without a farewell, then.
    }
    context.stop();
  }

  void listen_at(const tcp::endpoint& endpoint) {
    error_code error;
    tcp::acceptor& acceptor = acceptors.emplace_back(context);
    acceptor.open(endpoint.protocol(), error);
    if (!error) {
      acceptor.set_option(tcp::acceptor::reuse_address{true}, error);
      if (endpoint.address() == asio::ip::address{asio::ip::address_v6::any()}) {
        acceptor.set_option(asio::ip::v6_only{false}, error);  // every address of the machine
      }
      acceptor.bind(endpoint, error);
    }
    if (!error) {
      acceptor.listen(asio::socket_base::max_listen_connections, error);
    }
    if (!error) {
      acceptor.non_blocking(true, error);
    }
    if (error) {
      throw StartupError("command_socket.port: cannot listen on " + endpoint.address().to_string() +
                         " port " + std::to_string(endpoint.port()) + ": " + error.message());
    }
  }

  // Throws StartupError.
  void open() {
    error_code error;
    const auto reach = reach_of(options.address);
    const auto address = asio::ip::make_address(options.address, error);
    if (error || !reach) {
      throw StartupError("command_socket.address: \"" + options.address + "\" is no IP address");
    }
    if (options.tokens.command.empty()) {
      throw StartupError("command_socket.token_file: a token is required");
    }
    if (reach == Reach::kNetwork && options.lasting_tokens.command.empty()) {
      throw StartupError("command_socket.address: " + options.address +
                         " is not loopback, and that wants a token_file");
    }
    require_cryptography();
    listen_at({address, options.port});
    // Whoever is aboard reaches the boat without a network.
    if (reach == Reach::kNetwork && !address.is_unspecified()) {
      listen_at({asio::ip::address_v4::loopback(), port()});
    }
  }
  [[nodiscard]] std::uint16_t port() noexcept {
    error_code error;
    return acceptors.front().local_endpoint(error).port();
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
  std::list<tcp::acceptor> acceptors;
  Sessions sessions;
  ProofLimit limit;
  SpareDescriptor spare;
  std::jthread thread;
};

CommandSocket::CommandSocket(const CommandSocketOptions& options, CommandHandler handler,
                             CommandSocketEvents events)
    : impl_{std::make_unique<Impl>(options, std::move(handler), std::move(events))} {
  impl_->open();
  for (tcp::acceptor& acceptor : impl_->acceptors) {
    asio::co_spawn(impl_->context, impl_->listen(acceptor), asio::detached);
  }
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

std::uint16_t CommandSocket::port() const noexcept { return impl_->port(); }

}  // namespace lodesman
