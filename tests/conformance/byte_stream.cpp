// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/byte_stream.h"

#include <algorithm>
#include <numeric>

#include "tests/conformance/interposed.h"
#include "tests/conformance/line_bench.h"

namespace lodesman::conformance {
namespace {

using ByteStreams = std::tuple<MemoryLineBench, PtyBench, SerialPortBench>;
using std::chrono::hours;

[[nodiscard]] Bytes every_value() {
  Bytes bytes(256);
  std::iota(bytes.begin(), bytes.end(), std::uint8_t{0});
  return bytes;
}

TEMPLATE_LIST_TEST_CASE("byte stream: every value of a byte arrives, both ways and in order",
                        "[conformance]", ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  CHECK(bench.line().fault() == DeviceFault::kNone);
  REQUIRE(bench.device_sends(every_value()) == 256);
  CHECK(read_bytes(bench, 256) == every_value());
  REQUIRE(bench.line().write(every_value(), bench.now()) == 256);
  CHECK(receive_bytes(bench, 256) == every_value());
  CHECK(is_silent(bench));  // no echo
}

TEMPLATE_LIST_TEST_CASE("byte stream: what takes many reads arrives whole", "[conformance]",
                        ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes all = pattern(100000);
  Bytes got;
  Bytes piece(333);
  std::size_t sent = 0;
  REQUIRE(bench.settles([&] {
    for (std::size_t some = 1; some > 0 && got.size() < all.size();) {
      sent += bench.device_sends(
          std::span{all}.subspan(sent).first(std::min<std::size_t>(1000, all.size() - sent)));
      some = bench.line().read(piece, bench.now()).count;
      got.insert(got.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(some));
    }
    return true;
  }));
  while (got.size() < all.size()) {
    const Bytes more = read_bytes(bench, 1);
    REQUIRE(more.size() == 1);
    got.push_back(more[0]);
    sent += bench.device_sends(std::span{all}.subspan(sent));
  }
  CHECK(got == all);
}

TEMPLATE_LIST_TEST_CASE("byte stream: a full line takes a part, then none, and goes on untorn",
                        "[conformance]", ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  const Bytes all = pattern(300000);
  std::size_t taken = 0;
  // Nobody receives: there is an end to what it takes.
  REQUIRE(bench.settles([&] {
    const std::size_t some = bench.line().write(std::span{all}.subspan(taken, 777), bench.now());
    taken += some;
    return some == 0;
  }));
  CHECK(taken > 1000);
  REQUIRE(taken < all.size() / 2);
  CHECK(bench.line().connection(bench.now()) == 1);
  Bytes got;
  Bytes piece(999);
  REQUIRE(bench.settles([&] {
    const std::size_t some = bench.device_receives(piece);
    got.insert(got.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(some));
    if (some > 0 && taken < all.size()) {
      taken += bench.line().write(std::span{all}.subspan(taken), bench.now());
    }
    return got.size() >= all.size();
  }));
  CHECK(got == all);
  CHECK(bench.line().connection(bench.now()) == 1);
}

TEMPLATE_LIST_TEST_CASE("byte stream: a hang-up is known after a read or two", "[conformance]",
                        ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  bench.unplug();
  CHECK(is_silent(bench));
  CHECK(is_silent(bench));
  CHECK(bench.line().connection(bench.now()) == 0);
  CHECK(bench.line().fault() == DeviceFault::kUnplugged);
  const Bytes bytes(3);
  CHECK(bench.line().write(bytes, bench.now()) == 0);
  CHECK(is_silent(bench));
}

TEMPLATE_LIST_TEST_CASE("byte stream: the next connection has the next number and no old bytes",
                        "[conformance]", ByteStreams) {
  TestType bench;
  for (std::uint64_t number = 1; number <= 3; ++number) {
    REQUIRE(connect(bench) == number);
    const auto mark = static_cast<std::uint8_t>(number);
    REQUIRE(bench.device_sends(Bytes(20, mark)) == 20);
    CHECK(read_bytes(bench, 10) == Bytes(10, mark));  // the other ten are never asked for
    bench.unplug();
    REQUIRE(bench.settles([&] { return is_silent(bench); }));
    CHECK(is_silent(bench));
    CHECK(bench.line().connection(bench.now()) == 0);
    bench.plug();
  }
}

TEMPLATE_LIST_TEST_CASE("byte stream: another speed is another connection without old bytes",
                        "[conformance]", ByteStreams) {
  TestType bench;
  REQUIRE(connect(bench) == 1);
  REQUIRE(bench.device_sends(Bytes(20, 1)) == 20);
  CHECK(read_bytes(bench, 1) == Bytes{1});
  bench.line().reconnect(38400);
  CHECK(is_silent(bench));
  REQUIRE(connect(bench) == 2);
  CHECK(bench.line().fault() == DeviceFault::kNone);
  CHECK(is_silent(bench));
  REQUIRE(bench.device_sends(Bytes(5, 2)) == 5);
  CHECK(read_bytes(bench, 5) == Bytes(5, 2));
}

TEMPLATE_LIST_TEST_CASE("byte stream: without a device there is nothing, and that is said",
                        "[conformance]", ByteStreams) {
  TestType bench;
  bench.unplug();
  REQUIRE(bench.settles([&] {
    CHECK(bench.line().connection(bench.now()) == 0);
    CHECK(is_silent(bench));
    CHECK(bench.line().write(Bytes(3), bench.now()) == 0);
    return bench.line().fault() == DeviceFault::kNoPort;
  }));
  bench.plug();
  CHECK(connect(bench) == 1);
  CHECK(bench.line().fault() == DeviceFault::kNone);
}

TEMPLATE_LIST_TEST_CASE("byte stream: the wall clock may be set meanwhile", "[conformance]",
                        ByteStreams) {
  TestType bench;
  std::uint64_t number = 0;
  for (const hours ahead : {hours{-24}, hours{1}, hours{0}, hours{-1}}) {
    testing::set_wall_clock_ahead(ahead);
    REQUIRE(connect(bench) == ++number);
    REQUIRE(bench.device_sends(every_value()) == 256);
    CHECK(read_bytes(bench, 256) == every_value());
    bench.unplug();
    testing::set_wall_clock_ahead(-ahead);
    REQUIRE(bench.settles(
        [&] { return is_silent(bench) && bench.line().connection(bench.now()) == 0; }));
    bench.plug();
  }
  testing::set_wall_clock_ahead(hours{0});
}

TEST_CASE("byte stream: libserialport is what this suite has run over", "[conformance]") {
  const std::uint64_t before = testing::modem_lines_asked();
  testing::PtyDevice device;
  const OpenedPort opened = OpensSerialPort::open(device.path(), 57600);
  REQUIRE(opened.port);
  CHECK(dynamic_cast<const SerialPort*>(opened.port.get()) != nullptr);
  CHECK(testing::modem_lines_asked() > before);
  testing::PtyDevice other;
  const OpenedPort pty = OpensPty::open(other.path(), 57600);
  CHECK(dynamic_cast<const TermiosPort*>(pty.port.get()) != nullptr);
}

}  // namespace
}  // namespace lodesman::conformance
