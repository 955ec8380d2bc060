// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/command_relay.h"

#include <deque>
#include <optional>

#include <boost/asio.hpp>

#include "deploy/operator/console/json_values.h"
#include "high_level/mission/handshake.h"
#include "mid_level/base/clock.h"

namespace lodesman::console {
namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;
namespace {

constexpr std::size_t kMaxReply = std::size_t{1} << 20;  // [bytes] whatever it is that answers
constexpr Duration kRetryPeriod = std::chrono::milliseconds{20};
constexpr const char* kUnreached = "lodesman-high cannot be reached";

}  // namespace

// NOLINTBEGIN(misc-no-recursion): what a handler calls begins only after its own call has returned

// Held by what is under way too, so that an answer that comes late finds it; without an owner it
// tells nobody.
class CommandRelay::Link : public std::enable_shared_from_this<CommandRelay::Link> {
 public:
  Link(asio::io_context& context, const RelayOptions& options, TokenOf token)
      : socket_{context},
        deadline_{context},
        endpoint_{asio::ip::make_address(options.address), options.port},
        insistence_{options.insistence},
        token_{std::move(token)} {}

  void ask(const std::string& request, Done done) {
    if (waiting_.size() >= kMaxWaiting) {
      done({false, "too many commands are under way"});
      return;
    }
    waiting_.push_back({request, std::move(done), SteadyClock{}.now() + kPatience});
    go_on();
  }

  void abandon() {
    waiting_.clear();
    abandoned_ = true;
    close();
  }

 private:
  enum class State : std::uint8_t { kClosed, kConnecting, kChallenge, kProof, kReady, kAsked };
  struct Asked {
    std::string request;
    Done done;
    Time insist_until{};
  };

  void close() {
    error_code ignored;
    socket_.close(ignored);
    deadline_.cancel();
    buffer_.clear();
    sealed_.reset();
    state_ = State::kClosed;
    ++connection_;
  }

  // Of a connection that is not this one any more nothing counts.
  template <class Then>
  [[nodiscard]] auto of_this(Then then) {
    return
        [self = shared_from_this(), number = connection_, then](error_code error, auto&&... rest) {
          if (self->connection_ == number && !self->abandoned_) {
            if (error) {
              self->broken();
            } else {
              then(rest...);
            }
          }
        };
  }

  void go_on() {
    if (waiting_.empty() || abandoned_) {
      return;
    }
    if (state_ == State::kClosed) {
      connect();
    } else if (state_ == State::kReady) {
      send_next();
    }
  }

  void watch_deadline() {
    deadline_.expires_after(kPatience);
    deadline_.async_wait([self = shared_from_this(), number = connection_](error_code error) {
      if (!error && self->connection_ == number && self->state_ != State::kReady) {
        self->fail("no answer from lodesman-high");
      }
    });
  }

  void connect() {
    const std::string token = token_();
    if (token.empty() || endpoint_.port() == 0) {
      fail(std::string{kUnreached} + ": it has left no token");
      return;
    }
    handshake_.emplace(token, random_digest());
    state_ = State::kConnecting;
    watch_deadline();
    socket_.async_connect(endpoint_, of_this([this] {
                            error_code ignored;
                            socket_.set_option(tcp::no_delay{true}, ignored);
                            state_ = State::kChallenge;
                            send(handshake_request());
                            read();
                          }));
  }

  void send(std::string line) {
    const auto text = std::make_shared<std::string>(std::move(line) + "\n");
    asio::async_write(socket_, asio::buffer(*text), of_this([text](std::size_t) {}));
  }

  void read() {
    asio::async_read_until(socket_, asio::dynamic_buffer(buffer_, kMaxReply), '\n',
                           of_this([this](std::size_t length) {
                             const std::string line = buffer_.substr(0, length - 1);
                             buffer_.erase(0, length);
                             const std::uint64_t number = connection_;
                             hear(line);
                             if (connection_ == number && state_ != State::kClosed) {
                               read();
                             }
                           }));
  }

  void hear(const std::string& line) {
    switch (state_) {
      case State::kChallenge: return hear_challenge(line);
      case State::kProof: return hear_proof(line);
      case State::kAsked: return hear_reply(line);
      case State::kClosed:
      case State::kConnecting:
      case State::kReady: return broken();  // it says what nobody asked for
    }
  }

  void hear_challenge(const std::string& line) {
    if (const auto wrong = handshake_->hear_challenge(line)) {
      fail("the command socket " + *wrong);
      return;
    }
    state_ = State::kProof;
    send(handshake_->answer());
  }

  void hear_proof(const std::string& line) {
    if (handshake_->hear_proof(line)) {
      fail("this session's token is none of the boat's any more: sign in again");
      return;
    }
    sealed_.emplace(handshake_->keys(), SessionEnd::kClient);
    handshake_.reset();
    state_ = State::kReady;
    go_on();
  }

  void send_next() {
    state_ = State::kAsked;
    watch_deadline();
    send(sealed_->seal(waiting_.front().request));
  }

  void hear_reply(const std::string& line) {
    const auto opened = sealed_->open(line);
    if (!opened) {
      fail("the answer was altered on its way: what was asked for may be done or not");
      return;
    }
    state_ = State::kReady;
    deadline_.cancel();
    finish({true, *opened});
  }

  // An idle session that the boat has ended is opened again; a word that it may have read is said
  // again only if it stops the boat: a crowd may have pushed it out.
  void broken() {
    const bool unsaid = state_ == State::kReady;
    const bool unreached = state_ == State::kConnecting;
    close();
    if (waiting_.empty() || unsaid) {
      go_on();
    } else if (insistence_ == Insistence::kAgain &&
               SteadyClock{}.now() < waiting_.front().insist_until) {
      deadline_.expires_after(kRetryPeriod);
      deadline_.async_wait(of_this([this] { go_on(); }));
    } else {
      fail(unreached ? kUnreached : "lodesman-high ended the connection");
    }
  }

  // All that waits: the next will fare no better.
  void fail(const std::string& why) {
    close();
    const auto self = shared_from_this();
    std::deque<Asked> failed;
    failed.swap(waiting_);
    for (const Asked& asked : failed) {
      asked.done({false, why});
      if (abandoned_) {
        return;
      }
    }
  }

  void finish(const BoatReply& reply) {
    const auto self = shared_from_this();
    const Asked asked = std::move(waiting_.front());
    waiting_.pop_front();
    asked.done(reply);
    go_on();
  }

  tcp::socket socket_;
  asio::steady_timer deadline_;
  tcp::endpoint endpoint_;
  Insistence insistence_;
  TokenOf token_;
  State state_ = State::kClosed;
  std::uint64_t connection_ = 0;
  bool abandoned_ = false;
  std::string buffer_;
  std::deque<Asked> waiting_;
  std::optional<ClientHandshake> handshake_;
  std::optional<SealedLines> sealed_;
};

// NOLINTEND(misc-no-recursion)

CommandRelay::CommandRelay(asio::io_context& context, const RelayOptions& options, TokenOf token)
    : link_{std::make_shared<Link>(context, options, std::move(token))} {}

CommandRelay::~CommandRelay() { link_->abandon(); }

void CommandRelay::ask(const std::string& request, Done done) {
  link_->ask(request, std::move(done));
}

}  // namespace lodesman::console
