// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/datagram_socket.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>

#include "mid_level/base/startup_error.h"
#include "tests/conformance/datagram_bench.h"

namespace lodesman::conformance {
namespace {

using DatagramSockets = std::tuple<MemoryDatagramsBench, UdpBench>;

TEMPLATE_LIST_TEST_CASE("datagrams: of every size they arrive whole, both ways", "[conformance]",
                        DatagramSockets) {
  TestType bench;
  for (const std::size_t size : {1U, 0U, 255U, 256U, 1473U, 60256U, 65507U}) {
    INFO(size << " bytes");
    REQUIRE(bench.far_end().reply(datagram(size, 1)));
    const Arrived there = next_at(bench.near_end());
    REQUIRE(there.any);
    CHECK_FALSE(there.truncated);
    CHECK(there.bytes == datagram(size, 1));
    REQUIRE(bench.near_end().reply(datagram(size, 2)));
    CHECK(next_at(bench.far_end()).bytes == datagram(size, 2));
    std::array<std::uint8_t, 4> none{};
    CHECK_FALSE(bench.near_end().receive(none).any);
    CHECK_FALSE(bench.far_end().receive(none).any);
  }
}

TEMPLATE_LIST_TEST_CASE("datagrams: of one that does not fit the first part is given, and said so",
                        "[conformance]", DatagramSockets) {
  TestType bench;
  REQUIRE(bench.far_end().reply(datagram(1000, 1)));
  REQUIRE(bench.far_end().reply(datagram(300, 2)));
  const Arrived part = next_at(bench.near_end(), 300);
  REQUIRE(part.any);
  CHECK(part.truncated);
  Bytes expected = datagram(1000, 1);
  expected.resize(300);
  CHECK(part.bytes == expected);
  const Arrived next = next_at(bench.near_end(), 300);
  CHECK_FALSE(next.truncated);
  CHECK(next.bytes == datagram(300, 2));
}

TEMPLATE_LIST_TEST_CASE("datagrams: none is longer than UDP allows", "[conformance]",
                        DatagramSockets) {
  TestType bench;
  CHECK_FALSE(bench.far_end().reply(Bytes(kLargestDatagram + 1)));
  REQUIRE(bench.far_end().reply(datagram(5)));
  CHECK(next_at(bench.near_end()).bytes == datagram(5));
}

TEMPLATE_LIST_TEST_CASE("datagrams: who listens answers whom it has heard, and nobody before",
                        "[conformance]", DatagramSockets) {
  TestType bench;
  CHECK_FALSE(bench.near_end().reply(datagram(3)));
  REQUIRE(bench.far_end().reply(datagram(1)));
  REQUIRE(next_at(bench.near_end()).any);
  REQUIRE(bench.near_end().reply(datagram(3)));
  REQUIRE(bench.near_end().reply(datagram(4)));  // not only once
  CHECK(next_at(bench.far_end()).bytes == datagram(3));
  CHECK(next_at(bench.far_end()).bytes == datagram(4));
  CHECK(bench.near_end().fault() == DeviceFault::kNone);
}

TEMPLATE_LIST_TEST_CASE("datagrams: where nobody receives some are lost, and the rest is whole",
                        "[conformance]", DatagramSockets) {
  TestType bench;
  constexpr std::size_t kSent = 200;
  for (std::size_t i = 0; i < kSent; ++i) {
    static_cast<void>(bench.far_end().reply(datagram(60256, i)));
  }
  std::size_t last = 0;
  std::size_t count = 0;
  Bytes buffer(65536);
  for (auto got = bench.near_end().receive(buffer); got.any;
       got = bench.near_end().receive(buffer)) {
    REQUIRE(got.size == 60256);
    const Bytes bytes{buffer.begin(), buffer.begin() + 60256};
    while (last < kSent && bytes != datagram(60256, last)) {
      ++last;
    }
    ++count;
  }
  CHECK(last < kSent);  // each was one that was sent, in order
  CHECK(count >= 2);
  CHECK(count < kSent);
  REQUIRE(bench.far_end().reply(datagram(9)));
  CHECK(next_at(bench.near_end()).bytes == datagram(9));
}

TEST_CASE("datagrams: in memory nothing goes while it is unplugged, and that is said",
          "[conformance]") {
  const auto pair = std::make_unique<MemoryDatagrams>();
  pair->unplug();
  CHECK_FALSE(pair->far_end().reply(datagram(3)));
  CHECK(pair->near_end().fault() == DeviceFault::kNobodyListens);
  pair->plug();
  CHECK(pair->near_end().fault() == DeviceFault::kNone);
  REQUIRE(pair->far_end().reply(datagram(3)));
  CHECK(next_at(pair->near_end()).bytes == datagram(3));
}

// Sends from an address of its own of this computer's.
void send_from(const char* address, std::uint16_t port, const Bytes& bytes) {
  const FileDescriptor socket{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
  sockaddr_in name{};
  name.sin_family = AF_INET;
  REQUIRE(inet_pton(AF_INET, address, &name.sin_addr) == 1);
  const auto any = [&] { return static_cast<const sockaddr*>(static_cast<const void*>(&name)); };
  REQUIRE(bind(socket.value(), any(), sizeof(name)) == 0);
  REQUIRE(inet_pton(AF_INET, "127.0.0.1", &name.sin_addr) == 1);
  name.sin_port = htons(port);
  REQUIRE(sendto(socket.value(), bytes.data(), bytes.size(), 0, any(), sizeof(name)) ==
          static_cast<ssize_t>(bytes.size()));
}

TEST_CASE("datagrams: those of another computer are dropped and counted", "[conformance]") {
  UdpSocket socket{{"127.0.0.1"}};
  UdpSocket device{{"127.0.0.1", socket.local_port()}};
  for (int i = 0; i < 10; ++i) {
    send_from("127.0.0.2", socket.local_port(), datagram(100));
  }
  Bytes buffer(100);
  CHECK_FALSE(socket.receive(buffer).any);
  CHECK(socket.foreign() == 10);
  CHECK_FALSE(socket.reply(datagram(1)));  // nobody of ours has spoken
  REQUIRE(device.reply(datagram(20)));
  send_from("127.0.0.2", socket.local_port(), datagram(100));
  CHECK(next_at(socket).bytes == datagram(20));
  REQUIRE(socket.reply(datagram(7)));
  CHECK(next_at(device).bytes == datagram(7));
}

TEST_CASE("datagrams: of a peer with a port another port is another", "[conformance]") {
  UdpSocket socket{{"127.0.0.1"}};
  UdpSocket device{{"127.0.0.1", socket.local_port()}};
  send_from("127.0.0.1", device.local_port(), datagram(100));
  Bytes buffer(100);
  CHECK_FALSE(device.receive(buffer).any);
  CHECK(device.foreign() == 1);
}

TEST_CASE("datagrams: a flood of others holds nobody up", "[conformance]") {
  UdpSocket socket{{"127.0.0.1"}};
  for (int i = 0; i < 100; ++i) {
    send_from("127.0.0.3", socket.local_port(), datagram(1));
  }
  Bytes buffer(100);
  CHECK_FALSE(socket.receive(buffer).any);
  CHECK(socket.foreign() == 64);
  CHECK_FALSE(socket.receive(buffer).any);
  CHECK(socket.foreign() == 100);
}

TEST_CASE("datagrams: who has ended is known from the next that is sent to it", "[conformance]") {
  UdpSocket socket{{"127.0.0.1"}};
  std::uint16_t port = 0;
  {
    UdpSocket device{{"127.0.0.1", socket.local_port()}};
    port = device.local_port();
    REQUIRE(device.reply(datagram(3)));
    REQUIRE(next_at(socket).any);
  }
  Bytes buffer(100);
  CHECK(testing::eventually([&] {
    static_cast<void>(socket.reply(datagram(256)));
    static_cast<void>(socket.receive(buffer));
    return socket.fault() == DeviceFault::kNobodyListens;
  }));
  UdpSocket again{{"127.0.0.1", socket.local_port(), port}};
  REQUIRE(again.reply(datagram(4)));
  CHECK(next_at(socket).bytes == datagram(4));
  CHECK(socket.fault() == DeviceFault::kNone);
}

TEST_CASE("datagrams: a port that is taken and a peer that is none are refused", "[conformance]") {
  const UdpSocket first{{"127.0.0.1"}};
  CHECK_THROWS_AS((UdpSocket{{"127.0.0.1", 0, first.local_port()}}), StartupError);
  CHECK_THROWS_AS((UdpSocket{{"300.1.2.3"}}), StartupError);
  CHECK_THROWS_AS((UdpSocket{{""}}), StartupError);
}

TEST_CASE("datagrams: the bell rings for one that comes, and for the next", "[conformance]") {
  std::atomic<int> rings{0};
  UdpSocket socket{{"127.0.0.1"}, [&] { rings.fetch_add(1); }};
  UdpSocket device{{"127.0.0.1", socket.local_port()}};
  for (int i = 1; i <= 3; ++i) {  // though nobody takes them
    const int before = rings.load();
    REQUIRE(device.reply(datagram(60256)));
    CHECK(testing::eventually([&] { return rings.load() > before; }));
  }
  CHECK(socket.receive_buffer_bytes() > 2 * 60256);
}

}  // namespace
}  // namespace lodesman::conformance
