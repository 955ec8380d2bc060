// SPDX-License-Identifier: Apache-2.0
#include "drivers/maestro/commands.h"

#include <vector>

#include "tests/support/catch.h"

namespace lodesman::maestro {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[nodiscard]] Bytes bytes_of(const Packet& packet) {
  return {packet.bytes().begin(), packet.bytes().end()};
}

TEST_CASE("maestro: C-1 to C-4, targets in all three protocols", "[maestro]") {
  CHECK(bytes_of(set_target(0, 6000)) == Bytes{0x84, 0x00, 0x70, 0x2E});
  CHECK(bytes_of(addressed(set_target(0, 6000), 12)) == Bytes{0xAA, 0x0C, 0x04, 0x00, 0x70, 0x2E});
  CHECK(bytes_of(mini_ssc(0, 127)) == Bytes{0xFF, 0x00, 0x7F});
  CHECK(bytes_of(set_target(0, 6420)) == Bytes{0x84, 0x00, 0x14, 0x32});
  CHECK(bytes_of(set_target(1, 4650)) == Bytes{0x84, 0x01, 0x2A, 0x24});
}

TEST_CASE("maestro: C-5 to C-7, the check behind a packet", "[maestro]") {
  CHECK(crc7(Bytes{0x83, 0x01}) == 0x17);
  CHECK(crc7(Bytes{0xAA, 0x01, 0x10, 0x00}) == 0x6B);
  CHECK(bytes_of(with_crc(addressed(get_position(0), 1))) == Bytes{0xAA, 0x01, 0x10, 0x00, 0x6B});
  CHECK(bytes_of(with_crc(set_target(0, 6000))) == Bytes{0x84, 0x00, 0x70, 0x2E, 0x2B});
  CHECK(bytes_of(with_crc(get_position(0))) == Bytes{0x90, 0x00, 0x65});
  CHECK(bytes_of(with_crc(get_errors())) == Bytes{0xA1, 0x1B});
}

TEST_CASE("maestro: C-8 to C-10, what the answers mean", "[maestro]") {
  CHECK(reply_value(0x70, 0x17) == 6000);
  CHECK(reply_value(0x20, 0x00) == kTimeOutError);
  CHECK(reply_value(0x18, 0x00) == (kCrcError | kProtocolError));
}

TEST_CASE("maestro: no data byte is ever a command", "[maestro]") {
  for (unsigned target = 0; target < 1U << 14U; ++target) {
    const Packet packet = set_target(23, static_cast<std::uint16_t>(target));
    REQUIRE(packet.count == 4);
    for (const std::uint8_t byte : packet.bytes().subspan(1)) {
      REQUIRE(byte < 0x80);
    }
    REQUIRE(static_cast<unsigned>(packet.data[2] + 128 * packet.data[3]) == target);
    REQUIRE(with_crc(packet).data[4] < 0x80);
  }
}

}  // namespace
}  // namespace lodesman::maestro
