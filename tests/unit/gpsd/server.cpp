// SPDX-License-Identifier: Apache-2.0
// The driver against servers of the test's own, over a real socket.
#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>

#include "drivers/stream/file_descriptor.h"
#include "drivers/stream/make_line.h"
#include "drivers/stream/tcp_port.h"
#include "tests/support/pty_device.h"
#include "tests/unit/gpsd/support.h"

namespace lodesman::testing {
namespace {

// Listens on a port that is free.
class Server {
 public:
  explicit Server(std::uint16_t port = 0)
      : listening_{socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)} {
    const int on = 1;
    setsockopt(listening_.value(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* general = reinterpret_cast<sockaddr*>(&address);
    REQUIRE(bind(listening_.value(), general, size) == 0);
    REQUIRE(listen(listening_.value(), 4) == 0);
    REQUIRE(getsockname(listening_.value(), general, &size) == 0);
    port_ = ntohs(address.sin_port);
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] std::string place() const { return "127.0.0.1:" + std::to_string(port_); }
  [[nodiscard]] bool accepts() {
    return eventually([&] {
      client_ = FileDescriptor{accept(listening_.value(), nullptr, nullptr)};
      return client_.is_open();
    });
  }
  void say(const std::string& text) const {
    REQUIRE(send(client_.value(), text.data(), text.size(), MSG_NOSIGNAL) ==
            static_cast<ssize_t>(text.size()));
  }
  [[nodiscard]] bool hears(const std::string& expected) {
    return eventually([&] {
      char bytes[256];
      const ssize_t count = recv(client_.value(), bytes, sizeof bytes, MSG_DONTWAIT);
      heard_.append(bytes, count > 0 ? static_cast<std::size_t>(count) : 0);
      return heard_.find(expected) != std::string::npos;
    });
  }
  void hang_up() {
    client_ = FileDescriptor{};
    heard_.clear();
  }

 private:
  FileDescriptor listening_;
  FileDescriptor client_;
  std::uint16_t port_ = 0;
  std::string heard_;
};

// A driver on a real line, whose time is the test's.
struct Real {
  explicit Real(const std::string& place) : line{make_tcp_line(place)} {}

  [[nodiscard]] bool comes_to(const std::function<bool()>& holds) {
    return eventually([&] {
      now += milliseconds{1};
      const auto reading = driver.poll(now);
      status = reading.status;
      if (status == ReadStatus::kFresh) {
        fix = reading.sample;
        ++fixes;
      }
      return holds();
    });
  }

  std::unique_ptr<ByteStream> line;
  GpsdReceiver driver{*line, GpsdOptions{}};
  Time now{seconds{100}};
  ReadStatus status = ReadStatus::kNothingNew;
  PositionFix fix;
  int fixes = 0;
};

TEST_CASE("gpsd server: G2: gpsd dies and comes back, and the next newer fix is used", "[gpsd]") {
  auto server = std::make_unique<Server>();
  const std::uint16_t port = server->port();
  Real boat{server->place()};
  // Only the driver's polls write.
  REQUIRE(boat.comes_to([&] { return boat.line->connection(boat.now) != 0; }));
  REQUIRE(server->accepts());
  server->say(kGreeting);
  REQUIRE(boat.comes_to([] { return true; }));
  REQUIRE(server->hears("?WATCH="));
  server->say(tpv_line({}));
  REQUIRE(boat.comes_to([&] { return boat.fixes == 1; }));
  server.reset();
  REQUIRE(boat.comes_to([&] { return boat.status == ReadStatus::kDisconnected; }));
  CHECK(boat.comes_to([&] { return boat.driver.fault() == DeviceFault::kNoService; }));
  server = std::make_unique<Server>(port);
  REQUIRE(boat.comes_to([&] { return boat.status != ReadStatus::kDisconnected; }));
  REQUIRE(server->accepts());
  Told told;
  server->say(kGreeting + tpv_line(told));
  told.second = 9;
  server->say(tpv_line(told));
  REQUIRE(boat.comes_to([&] { return boat.fixes == 2; }));
  CHECK(boat.fix.utc_ns == 1795264509'000'000'000);
  CHECK(boat.driver.counts().repeated == 1);
}

TEST_CASE("gpsd server: one that closes each connection at once is not asked without a pause",
          "[gpsd]") {
  Server server;
  Real boat{server.place()};
  int accepted = 0;
  const auto begun = std::chrono::steady_clock::now();
  while (std::chrono::steady_clock::now() - begun < seconds{2}) {
    boat.now += milliseconds{1};
    static_cast<void>(boat.driver.poll(boat.now));
    if (boat.line->connection(boat.now) != 0 && server.accepts()) {
      ++accepted;
      server.hang_up();
      REQUIRE(boat.comes_to([&] { return boat.line->connection(boat.now) == 0; }));
    }
    std::this_thread::sleep_for(milliseconds{1});
  }
  CHECK(accepted >= 2);
  CHECK(accepted <= 8);  // pauses of 0.1, 0.2, 0.4, 0.8, 1 s
}

TEST_CASE("gpsd server: where nothing listens that is said, and a name that is none likewise",
          "[gpsd]") {
  std::string place;
  {
    const Server gone;
    place = gone.place();
  }
  Real boat{place};
  CHECK(boat.comes_to([&] { return boat.driver.fault() == DeviceFault::kNoService; }));
  CHECK(boat.status == ReadStatus::kDisconnected);
  CHECK(TcpPort::open("127.0.0.1").fault == DeviceFault::kNoService);
  CHECK(TcpPort::open(":2947").fault == DeviceFault::kNoService);
  CHECK(TcpPort::open("[x]:2947").fault == DeviceFault::kNoService);
}

}  // namespace
}  // namespace lodesman::testing
