// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/wire.h"

#include <algorithm>

#include "tests/support/catch.h"
#include "tests/unit/emulators/support.h"

namespace lodesman {
namespace {

using namespace lodesman::testing;
using std::chrono::microseconds;
using std::chrono::milliseconds;

[[nodiscard]] std::vector<TimedByte> carried(EmulatedWire& wire, Time until) {
  std::vector<TimedByte> bytes;
  wire.to_host(until, bytes);
  return bytes;
}
[[nodiscard]] Bytes values(const std::vector<TimedByte>& bytes) {
  Bytes all;
  for (const TimedByte& byte : bytes) {
    all.push_back(byte.value);
  }
  return all;
}

TEST_CASE("wire: a byte takes ten bits, one after the other, both ways", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.from_device({at_ms(10), {1, 2}}, false, 9600, 9600);
  wire.from_device({at_ms(10), {3}}, false, 9600, 9600);
  wire.from_device({at_ms(100), {4}}, false, 9600, 9600);
  const auto bytes = carried(wire, at_ms(50));
  REQUIRE(values(bytes) == Bytes{1, 2, 3});
  const Duration one = Duration{std::chrono::seconds{10}} / 9600;
  CHECK(bytes[0].at == at_ms(10) + one);
  CHECK(bytes[2].at == at_ms(10) + 3 * one);
  CHECK(values(carried(wire, at_ms(100))) == Bytes{4});
  wire.from_host(7, at_ms(200), 9600, 9600);
  wire.from_host(8, at_ms(200), 9600, 9600);
  CHECK_FALSE(wire.next_to_device(at_ms(201)));
  const auto first = wire.next_to_device(at_ms(202));
  REQUIRE(first);
  CHECK(first->value == 7);
  CHECK(first->at == at_ms(200) + one);
  CHECK_FALSE(wire.next_to_device(at_ms(202)));
  CHECK(wire.next_to_device(at_ms(203))->at == at_ms(200) + 2 * one);
}

TEST_CASE("wire: without a speed, or told so, bytes take no time", "[hal_sim][emulators]") {
  EmulatedWire box{"test", 1};
  box.from_device({at_ms(10), {1, 2}}, false, 0, 0);
  CHECK(carried(box, at_ms(10)).at(1).at == at_ms(10));
  EmulatedWire instant{"test", 1, {.instant = true}};
  instant.from_device({at_ms(10), {1, 2}}, false, 9600, 9600);
  CHECK(carried(instant, at_ms(10)).at(1).at == at_ms(10));
}

TEST_CASE("wire: an adapter hands on at multiples of 16 ms, or 62 bytes", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1, {.batch = milliseconds{16}, .usb_frame = milliseconds{1}}};
  wire.from_device({at_ms(17), Bytes(10, 1)}, false, 38400, 38400);
  CHECK(carried(wire, at_ms(31)).empty());
  const auto batch = carried(wire, at_ms(32));
  REQUIRE(batch.size() == 10);
  CHECK(batch.front().at == at_ms(32));
  CHECK(batch.back().at == at_ms(32));
  wire.from_device({at_ms(33), Bytes(70, 2)}, false, 0, 57600);
  const auto full = carried(wire, at_ms(40));
  REQUIRE(full.size() == 62);  // 62 bytes of 173.6 us each, and the next frame of the bus
  CHECK(full.back().at == at_ms(44));
  const auto rest = carried(wire, at_ms(48));
  REQUIRE(rest.size() == 8);
  CHECK(rest.back().at == at_ms(48));
}

TEST_CASE("wire: a bus hands on at its frames", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1, {.usb_frame = milliseconds{1}}};
  wire.from_device({at_ms(10) + microseconds{1}, {1}}, false, 0, 0);
  wire.from_device({at_ms(12), {2}}, false, 0, 0);
  const auto bytes = carried(wire, at_ms(12));
  REQUIRE(bytes.size() == 2);
  CHECK(bytes[0].at == at_ms(11));
  CHECK(bytes[1].at == at_ms(12));
}

TEST_CASE("wire: at another speed anything arrives, and is counted", "[hal_sim][emulators]") {
  const auto garbage = [](std::uint64_t seed) {
    EmulatedWire wire{"test", seed};
    wire.from_device({at_ms(0), Bytes(200, 0x55)}, false, 9600, 38400);
    Bytes bytes = values(carried(wire, at_ms(0)));
    CHECK(wire.garbled() == 200);
    wire.from_host(0x55, at_ms(0), 9600, 38400);
    CHECK(wire.garbled() == 201);
    wire.from_host(0x55, at_ms(0), 0, 38400);  // a host that has no speed
    CHECK(wire.garbled() == 201);
    return bytes;
  };
  const Bytes bytes = garbage(3);
  CHECK(bytes.size() == 200);
  CHECK(std::count(bytes.begin(), bytes.end(), 0x55) < 20);
  CHECK(bytes == garbage(3));
  CHECK(bytes != garbage(4));
}

TEST_CASE("wire: unplugged, nothing goes, and what was under way is lost", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.advance(at_ms(0));
  wire.from_device({at_ms(5), {1}}, false, 0, 0);
  wire.from_host(1, at_ms(0), 9600, 9600);
  const Fault gone = ahrs_fault(FaultKind::kDisconnect);
  wire.begin_fault(gone, at_ms(0));
  wire.advance(at_ms(0));
  CHECK_FALSE(wire.plugged());
  wire.from_device({at_ms(5), {2}}, false, 0, 0);
  wire.from_host(2, at_ms(1), 9600, 9600);
  CHECK(carried(wire, at_ms(10)).empty());
  wire.end_fault(gone);
  wire.advance(at_ms(10));
  CHECK(wire.plugged());
  CHECK(carried(wire, at_ms(10)).empty());
  CHECK_FALSE(wire.next_to_device(at_ms(10)));
  wire.from_device({at_ms(11), {3}}, false, 0, 0);
  CHECK(values(carried(wire, at_ms(11))) == Bytes{3});
  CHECK(wire.injections().of(FaultKind::kDisconnect).count == 1);
  CHECK(wire.injections().of(FaultKind::kDisconnect).last == at_ms(0));
}

TEST_CASE("wire: stalled, it stays plugged in and carries nothing", "[hal_sim][emulators]") {
  EmulatedWire wire{"test", 1};
  wire.begin_fault(ahrs_fault(FaultKind::kStall), at_ms(0));
  wire.advance(at_ms(1));
  CHECK(wire.plugged());
  wire.from_device({at_ms(1), {1}}, false, 0, 0);
  wire.from_host(1, at_ms(1), 0, 0);
  CHECK(carried(wire, at_ms(2)).empty());
  CHECK_FALSE(wire.next_to_device(at_ms(2)));
}

}  // namespace
}  // namespace lodesman
