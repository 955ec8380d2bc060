// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/memory_line.h"

#include <memory>
#include <thread>
#include <vector>

#include "tests/support/catch.h"

using namespace lodesman;
using std::chrono::milliseconds;

namespace {
constexpr Time at(int ms) { return Time{milliseconds{1000 + ms}}; }
}  // namespace

TEST_CASE("memory line: bytes come when they arrive, in order", "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  ByteStream& near = line->near_end();
  REQUIRE(near.connection(at(0)) == 1);
  for (std::uint8_t byte = 1; byte <= 5; ++byte) {
    REQUIRE(line->send(byte, at(10 * byte)));
  }
  std::array<std::uint8_t, 8> bytes{};
  CHECK(near.read(bytes, at(9)).count == 0);
  const Received two = near.read(bytes, at(29));
  CHECK(two.count == 2);
  CHECK(two.at == at(20));
  CHECK(bytes[0] == 1);
  CHECK(bytes[1] == 2);
  CHECK(near.read(std::span{bytes}.first(1), at(99)).count == 1);
  CHECK(bytes[0] == 3);
  CHECK(near.read(bytes, at(99)).count == 2);
  CHECK(near.read(bytes, at(999)).count == 0);
}

TEST_CASE("memory line: what is written arrives after its delay, and a full line takes no more",
          "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  line->set_outward_delay(milliseconds{7});
  line->set_outward_room(4);
  REQUIRE(line->near_end().connection(at(0)) == 1);
  const std::array<std::uint8_t, 6> sent{1, 2, 3, 4, 5, 6};
  CHECK(line->near_end().write(sent, at(0)) == 4);
  CHECK(line->near_end().write(sent, at(0)) == 0);
  std::array<std::uint8_t, 8> bytes{};
  CHECK(line->receive(bytes, at(6)).count == 0);
  CHECK(line->receive(bytes, at(7)).count == 4);
  CHECK(bytes[3] == 4);
  CHECK(line->near_end().write(sent, at(8)) == 4);
}

TEST_CASE("memory line: unplugged it is silent, and plugged again another connection",
          "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  ByteStream& near = line->near_end();
  line->unplug();
  CHECK(near.connection(at(0)) == 0);
  CHECK(near.fault() == DeviceFault::kNoPort);
  line->plug();
  CHECK(near.connection(at(1)) == 1);
  CHECK(near.fault() == DeviceFault::kNone);
  REQUIRE(line->send(1, at(2)));
  line->unplug();
  line->unplug();
  std::array<std::uint8_t, 8> bytes{};
  CHECK(near.read(bytes, at(3)).count == 0);
  CHECK(near.write(bytes, at(3)) == 0);
  CHECK(near.connection(at(3)) == 0);
  CHECK(near.fault() == DeviceFault::kUnplugged);
  CHECK_FALSE(line->send(2, at(4)));
  line->plug();
  CHECK(near.connection(at(5)) == 2);
  REQUIRE(line->send(3, at(6)));
  REQUIRE(near.read(bytes, at(7)).count == 1);
  CHECK(bytes[0] == 3);
}

TEST_CASE("memory line: one that was pulled and plugged between two looks is another connection",
          "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  ByteStream& near = line->near_end();
  REQUIRE(near.connection(at(0)) == 1);
  REQUIRE(line->send(1, at(1)));
  line->unplug();
  line->plug();
  std::array<std::uint8_t, 8> bytes{};
  CHECK(near.read(bytes, at(2)).count == 0);
  CHECK(near.connection(at(2)) == 2);
  CHECK(near.read(bytes, at(2)).count == 0);
}

TEST_CASE("memory line: the near end gives a connection up for another speed", "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  ByteStream& near = line->near_end();
  REQUIRE(near.connection(at(0)) == 1);
  CHECK(line->baud() == 0);
  REQUIRE(line->send(1, at(1)));
  near.reconnect(57600);
  std::array<std::uint8_t, 8> bytes{};
  CHECK(near.read(bytes, at(2)).count == 0);
  CHECK(near.connection(at(2)) == 2);
  CHECK(line->baud() == 57600);
  CHECK(near.read(bytes, at(2)).count == 0);
}

TEST_CASE("memory line: a full one loses nothing that it took", "[drivers]") {
  const auto line = std::make_unique<MemoryLine>();
  REQUIRE(line->near_end().connection(at(0)) == 1);
  std::size_t taken = 0;
  while (line->send(static_cast<std::uint8_t>(taken), at(0))) {
    ++taken;
  }
  CHECK(taken == TimedBytes::kCapacity);
  std::vector<std::uint8_t> bytes(2 * TimedBytes::kCapacity);
  REQUIRE(line->near_end().read(bytes, at(0)).count == taken);
  for (std::size_t i = 0; i < taken; ++i) {
    REQUIRE(bytes[i] == static_cast<std::uint8_t>(i));
  }
}

TEST_CASE("memory line: its two ends may be two threads", "[drivers]") {
  constexpr std::size_t kBytes = 200000;
  const auto line = std::make_unique<MemoryLine>();
  ByteStream& near = line->near_end();
  REQUIRE(near.connection(at(0)) == 1);
  std::jthread device{[&line] {
    for (std::size_t sent = 0; sent < kBytes;) {
      sent += line->send(static_cast<std::uint8_t>(sent % 251), at(0)) ? 1U : 0U;
    }
  }};
  std::array<std::uint8_t, 100> bytes{};
  for (std::size_t got = 0; got < kBytes;) {
    const Received received = near.read(bytes, at(0));
    for (std::size_t i = 0; i < received.count; ++i, ++got) {
      REQUIRE(bytes[i] == got % 251);
    }
  }
}
