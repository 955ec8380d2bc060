// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/console_server.h"

#include <array>
#include <list>
#include <optional>
#include <thread>
#include <utility>  // Boost 1.74 uses std::exchange without including it

#include <boost/asio.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>

#include "deploy/operator/console/command_relay.h"
#include "deploy/operator/console/foxglove.h"
#include "mid_level/base/clock.h"

namespace lodesman::console {
namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = boost::beast::http;
namespace websocket = boost::beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;
namespace {

constexpr std::uint32_t kMaxHeader = 16 * 1024;           // [bytes]
constexpr std::size_t kMaxBody = std::size_t{64} * 1024;  // [bytes] of requests, messages
constexpr std::size_t kMaxConnections = 192;              // viewers included
constexpr int kSendBuffer = 128 * 1024;                   // [bytes] so that what waits there is new
constexpr std::chrono::milliseconds kAcceptPause{50};
constexpr std::chrono::milliseconds kFarewellLimit{300};
constexpr std::chrono::seconds kSilenceLimit{30};  // of a viewer that answers no ping

using WebSocket = websocket::stream<beast::tcp_stream>;
using Request = http::request<http::string_body>;

[[nodiscard]] std::string text(beast::string_view view) { return {view.data(), view.size()}; }

[[nodiscard]] HttpRequest plain(const Request& request) {
  HttpRequest asked{std::string{request.method_string()},
                    text(request.target()),
                    text(request[http::field::host]),
                    std::nullopt,
                    text(request[http::field::content_type]),
                    text(request[http::field::cookie]),
                    request.body()};
  if (request.count(http::field::origin) > 0) {
    asked.origin = text(request[http::field::origin]);
  }
  return asked;
}

[[nodiscard]] http::response<http::string_body> response_of(HttpReply reply, const Request& request,
                                                            bool keep_alive) {
  http::response<http::string_body> response{static_cast<http::status>(reply.status),
                                             request.version() == 10 ? 10U : 11U};
  for (const auto& [name, value] : common_headers()) {
    response.set(name, value);
  }
  for (const auto& [name, value] : reply.headers) {
    response.set(name, value);
  }
  if (!reply.content_type.empty()) {
    response.set(http::field::content_type, reply.content_type);
  }
  response.keep_alive(keep_alive);
  if (reply.status != 204) {
    response.body() = std::move(reply.body);
    response.prepare_payload();
  }
  if (request.method() == http::verb::head) {
    response.body().clear();  // its length stays said
  }
  return response;
}

}  // namespace

// One connection from its first byte to its last: requests, and then perhaps a viewer.
struct Connection {
  explicit Connection(tcp::socket socket)
      : stream{std::move(socket)}, work{stream.get_executor()} {}

  [[nodiscard]] tcp::socket& socket() {
    return viewer ? beast::get_lowest_layer(*viewer).socket() : stream.socket();
  }
  void close() {
    error_code ignored;
    socket().close(ignored);
    work.cancel();
  }

  beast::tcp_stream stream;
  beast::flat_buffer buffer{kMaxHeader + kMaxBody};
  std::optional<WebSocket> viewer;
  std::shared_ptr<Client> client;
  asio::steady_timer work;            // cancelled when there is something to send
  std::optional<Time> sending_since;  // a message is under way
};

struct ConsoleServer::Impl {
  using Connections = std::list<std::shared_ptr<Connection>>;

  Impl(const ServerOptions& options_in, const ConsoleOptions& console_options)
      : options{options_in},
        command_port{console_options.command_port},
        console{console_options, [this](TokenOf token, Insistence insistence) {
                  return std::make_unique<CommandRelay>(
                      context, RelayOptions{options.command_address, command_port, insistence},
                      std::move(token));
                }} {
    listen();
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  ~Impl() {
    if (thread.joinable()) {
      asio::post(context, [this] {
        stopping = true;
        error_code ignored;
        acceptor.close(ignored);
        ticker.cancel();
        for (const auto& connection : connections) {
          connection->close();
        }
      });
      thread.join();
    }
  }

  void listen() {
    const auto address = asio::ip::make_address(options.address);
    error_code error;
    for (int i = 0; i <= (options.or_next ? kNextPorts : 0); ++i) {
      const int port = options.port + (options.port == 0 ? 0 : i);
      const tcp::endpoint endpoint{address, static_cast<std::uint16_t>(port)};
      error_code ignored;
      acceptor.close(ignored);
      acceptor.open(endpoint.protocol(), error);
      if (!error) {
        acceptor.set_option(asio::socket_base::reuse_address{true}, ignored);
        acceptor.bind(endpoint, error);
      }
      if (!error) {
        acceptor.listen(asio::socket_base::max_listen_connections, error);
      }
      if (error != asio::error::address_in_use) {
        break;
      }
    }
    const std::string where = options.address + " port " + std::to_string(options.port);
    if (error == asio::error::address_in_use) {
      throw PortTaken("console: another program listens at " + where);
    }
    if (error) {
      throw StartupError("console: cannot listen at " + where + ": " + error.message());
    }
  }

  asio::awaitable<void> accept() {
    while (!stopping) {
      error_code error;
      tcp::socket socket =
          co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
      if (stopping) {
        co_return;
      }
      if (error) {  // no descriptors left, perhaps
        pause.expires_after(kAcceptPause);
        co_await pause.async_wait(asio::redirect_error(asio::use_awaitable, error));
        continue;
      }
      take_in(std::move(socket));
    }
  }

  // Where all places are taken the one that is no viewer and was there longest gives way.
  void take_in(tcp::socket socket) {
    if (connections.size() >= kMaxConnections) {
      for (const auto& connection : connections) {
        if (!connection->client) {
          connection->close();
          break;
        }
      }
    }
    if (connections.size() >= 2 * kMaxConnections) {
      return;  // those that gave way have not gone yet
    }
    error_code ignored;
    socket.set_option(tcp::no_delay{true}, ignored);
    socket.set_option(asio::socket_base::send_buffer_size{kSendBuffer}, ignored);
    const auto connection = std::make_shared<Connection>(std::move(socket));
    connections.push_back(connection);
    asio::co_spawn(context, serve(connection),
                   [this, connection](const std::exception_ptr&) { leave(*connection); });
  }

  void leave(Connection& connection) {
    if (connection.client) {
      console.remove_client(*connection.client);
    }
    connection.close();
    connections.remove_if([&](const auto& kept) { return kept.get() == &connection; });
  }

  // Request by request, as long as the connection is kept.
  asio::awaitable<void> serve(std::shared_ptr<Connection> connection) {
    for (bool keep = true; keep;) {
      http::request_parser<http::string_body> parser;
      parser.header_limit(kMaxHeader);
      parser.body_limit(kMaxBody);
      connection->stream.expires_after(options.header_limit);
      error_code error;
      co_await http::async_read_header(connection->stream, connection->buffer, parser,
                                       asio::redirect_error(asio::use_awaitable, error));
      if (!error && websocket::is_upgrade(parser.get())) {
        keep = co_await begin_viewer(*connection, parser.get());
        if (connection->client) {
          co_await view(connection);
          co_return;
        }
        continue;
      }
      if (!error) {
        connection->stream.expires_after(options.header_limit);
        co_await http::async_read(connection->stream, connection->buffer, parser,
                                  asio::redirect_error(asio::use_awaitable, error));
      }
      if (error) {
        co_await refuse(*connection, parser.get(), error);
        co_return;
      }
      keep = parser.get().keep_alive();
      co_await send(*connection, console.answer(plain(parser.get()), now()), parser.get(), keep);
    }
  }

  asio::awaitable<void> send(Connection& connection, HttpReply reply, const Request& request,
                             bool keep_alive) {
    auto response = response_of(std::move(reply), request, keep_alive);
    connection.stream.expires_after(options.header_limit);
    co_await http::async_write(connection.stream, response, asio::use_awaitable);
  }

  // What was no request, where it is worth an answer.
  asio::awaitable<void> refuse(Connection& connection, const Request& request, error_code error) {
    if (error == http::error::body_limit) {
      co_await send(connection, error_reply(413, "too long"), request, false);
    } else if (error == http::error::header_limit || error == http::error::buffer_overflow) {
      co_await send(connection, error_reply(431, "too long a header"), request, false);
    } else if (error.category() == http::make_error_code(http::error::bad_method).category() &&
               error != http::error::end_of_stream && error != http::error::partial_message) {
      co_await send(connection, error_reply(400, "this is no request"), request, false);
    }
  }

  // Whether the connection is kept; it has a client where there is a viewer now.
  asio::awaitable<bool> begin_viewer(Connection& connection, const Request& request) {
    const Console::Admission admission = console.admit(plain(request), now());
    const std::string protocol =
        foxglove::subprotocol_of(text(request[http::field::sec_websocket_protocol]));
    if (!admission.rights || protocol.empty()) {
      HttpReply refusal = admission.rights
                              ? error_reply(400, "speak foxglove.sdk.v1 or foxglove.websocket.v1")
                              : admission.refusal;
      co_await send(connection, std::move(refusal), request, false);
      co_return false;
    }
    connection.stream.expires_never();
    connection.viewer.emplace(std::move(connection.stream));
    WebSocket& viewer = *connection.viewer;
    viewer.set_option(websocket::stream_base::timeout{options.header_limit, kSilenceLimit, true});
    viewer.set_option(websocket::stream_base::decorator([&](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, protocol);
      for (const auto& [name, value] : common_headers()) {
        response.set(name, value);
      }
    }));
    viewer.read_message_max(kMaxBody);
    viewer.auto_fragment(false);
    co_await viewer.async_accept(request, asio::use_awaitable);
    connection.client = console.add_client(*admission.rights);
    co_return false;
  }

  // Reads until the viewer or its session ends; what is sent is another coroutine's.
  asio::awaitable<void> view(std::shared_ptr<Connection> connection) {
    connection->client->on_work = [weak = std::weak_ptr{connection}] {
      if (const auto kept = weak.lock()) {
        kept->work.cancel();
      }
    };
    asio::co_spawn(context, tell(connection), asio::detached);
    beast::flat_buffer buffer;
    error_code error;
    while (!error && !connection->client->is_over()) {
      co_await connection->viewer->async_read(buffer,
                                              asio::redirect_error(asio::use_awaitable, error));
      if (!error) {
        const auto bytes = buffer.cdata();
        connection->client->hear(connection->viewer->got_text(),
                                 {static_cast<const char*>(bytes.data()), bytes.size()}, now());
        buffer.consume(buffer.size());
      }
    }
    connection->client->end();
  }

  asio::awaitable<void> tell(std::shared_ptr<Connection> connection) {
    Client& client = *connection->client;
    error_code error;
    while (!error && !client.is_over()) {
      std::optional<Frame> frame = client.take();
      if (!frame) {
        connection->work.expires_at(asio::steady_timer::time_point::max());
        error_code woken;
        co_await connection->work.async_wait(asio::redirect_error(asio::use_awaitable, woken));
        continue;
      }
      const std::array<asio::const_buffer, 2> parts{
          asio::buffer(frame->head),
          frame->body ? asio::buffer(frame->body->json) : asio::const_buffer{}};
      connection->viewer->text(frame->is_text);
      connection->sending_since = now();
      co_await connection->viewer->async_write(parts,
                                               asio::redirect_error(asio::use_awaitable, error));
      connection->sending_since.reset();
    }
    connection->close();  // ends what reads too
  }

  asio::awaitable<void> tick() {
    while (!stopping) {
      ticker.expires_after(Console::kLookPeriod);
      error_code error;
      co_await ticker.async_wait(asio::redirect_error(asio::use_awaitable, error));
      if (stopping) {
        co_return;
      }
      const Time at = now();
      console.step(at);
      for (const auto& connection : connections) {
        if (connection->sending_since && at - *connection->sending_since > options.stall_limit) {
          connection->close();
        }
      }
    }
  }

  void run() {
    asio::co_spawn(context, accept(), asio::detached);
    asio::co_spawn(context, tick(), asio::detached);
    while (!stopping) {
      context.run_one();
    }
    // What was under way sees that its socket is closed.
    context.restart();
    context.run_for(kFarewellLimit);
  }

  [[nodiscard]] static Time now() noexcept { return SteadyClock{}.now(); }

  ServerOptions options;
  std::uint16_t command_port;
  asio::io_context context{1};
  tcp::acceptor acceptor{context};
  asio::steady_timer pause{context};
  asio::steady_timer ticker{context};
  bool stopping = false;  // the thread's own
  Console console;
  Connections connections;
  std::thread thread;
};

ConsoleServer::ConsoleServer(const ServerOptions& options, const ConsoleOptions& console)
    : impl_{std::make_unique<Impl>(options, console)} {}
ConsoleServer::~ConsoleServer() = default;

std::uint16_t ConsoleServer::port() const noexcept {
  error_code ignored;
  return impl_->acceptor.local_endpoint(ignored).port();
}

std::string ConsoleServer::make_one_time_token() { return impl_->console.make_one_time_token(); }

void ConsoleServer::start() {
  impl_->thread = std::thread{[this] { impl_->run(); }};
}

}  // namespace lodesman::console
