// SPDX-License-Identifier: Apache-2.0
#include "drivers/roboclaw/packets.h"

#include <string>
#include <vector>

#include "tests/support/catch.h"

namespace lodesman::roboclaw {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[nodiscard]] Bytes bytes_of(const Packet& packet) {
  return {packet.bytes().begin(), packet.bytes().end()};
}

// Its data with the check that belongs to it.
[[nodiscard]] Bytes reply_of(std::uint8_t address, Command command, Bytes data) {
  Bytes all{address, static_cast<std::uint8_t>(command)};
  all.insert(all.end(), data.begin(), data.end());
  const std::uint16_t crc = crc16(all);
  data.push_back(static_cast<std::uint8_t>(crc >> 8U));
  data.push_back(static_cast<std::uint8_t>(crc & 0xFFU));
  return data;
}

[[nodiscard]] std::optional<Bytes> data_of(std::uint8_t address, Command command,
                                           const Bytes& received) {
  const auto data = reply_data(address, command, received);
  return data ? std::optional{Bytes{data->begin(), data->end()}} : std::nullopt;
}

TEST_CASE("roboclaw: C-11 to C-14 and C-16, what is said", "[roboclaw]") {
  CHECK(bytes_of(write_byte(0x80, Command::kForward1, 64)) == Bytes{0x80, 0x00, 0x40, 0x73, 0x9E});
  CHECK(bytes_of(duty_both(0x80, 16384, -16384)) ==
        Bytes{0x80, 0x22, 0x40, 0x00, 0xC0, 0x00, 0xE0, 0xDF});
  CHECK(bytes_of(duty_both(0x80, 0, 0)) == Bytes{0x80, 0x22, 0x00, 0x00, 0x00, 0x00, 0x98, 0x17});
  CHECK(bytes_of(write_byte(0x80, Command::kDrive1, 64)) == Bytes{0x80, 0x06, 0x40, 0xD9, 0x38});
  CHECK(bytes_of(write_byte(0x80, Command::kSetTimeOut, 10)) ==
        Bytes{0x80, 0x0E, 0x0A, 0xB9, 0x1F});
  CHECK(bytes_of(read_request(0x80, Command::kReadMainBattery)) == Bytes{0x80, 0x18});
}

TEST_CASE("roboclaw: C-15, the battery", "[roboclaw]") {
  const Bytes reply{0x00, 0xFC, 0x19, 0x69};
  const auto data = reply_data(0x80, Command::kReadMainBattery, reply);
  REQUIRE(data);
  CHECK(unsigned_of(*data) * kBatteryUnit_volts == Approx(25.2));
  CHECK_FALSE(reply_data(0x81, Command::kReadMainBattery, reply));
  CHECK_FALSE(reply_data(0x80, Command::kReadLogicBattery, reply));
}

TEST_CASE("roboclaw: a duty is signed", "[roboclaw]") {
  const Packet packet = duty_both(0x80, -32767, -1);
  CHECK(signed_of(std::span{packet.data}.subspan<2, 2>()) == -32767);
  CHECK(signed_of(std::span{packet.data}.subspan<4, 2>()) == -1);
}

TEST_CASE("roboclaw: T8, the length of a status is known by its check", "[roboclaw]") {
  for (unsigned value = 0; value < 0x10000U; value += 7) {
    const Bytes two{static_cast<std::uint8_t>(value >> 8U), static_cast<std::uint8_t>(value)};
    const Bytes four{0x01, 0x02, two[0], two[1]};
    REQUIRE(data_of(0x80, Command::kReadStatus, reply_of(0x80, Command::kReadStatus, two)) == two);
    REQUIRE(data_of(0x80, Command::kReadStatus, reply_of(0x80, Command::kReadStatus, four)) ==
            four);
  }
}

TEST_CASE("roboclaw: a reply is whole, right, and alone but for late acknowledges", "[roboclaw]") {
  const Bytes reply = reply_of(0x80, Command::kReadDuties, {0x12, 0x34, 0xFF, 0xFF});
  CHECK(data_of(0x80, Command::kReadDuties, reply) == Bytes{0x12, 0x34, 0xFF, 0xFF});
  Bytes late = reply;
  late.insert(late.begin(), {0xFF, 0xFF});
  CHECK(data_of(0x80, Command::kReadDuties, late) == Bytes{0x12, 0x34, 0xFF, 0xFF});
  late.front() = 0xFE;
  CHECK_FALSE(data_of(0x80, Command::kReadDuties, late));
  for (std::size_t i = 0; i < reply.size(); ++i) {
    CHECK_FALSE(data_of(0x80, Command::kReadDuties,
                        Bytes(reply.begin(), reply.begin() + static_cast<std::ptrdiff_t>(i))));
    Bytes damaged = reply;
    damaged[i] = static_cast<std::uint8_t>(damaged[i] ^ 0x04U);
    CHECK_FALSE(data_of(0x80, Command::kReadDuties, damaged));
  }
  late = reply;
  late.push_back(0xFF);
  CHECK_FALSE(data_of(0x80, Command::kReadDuties, late));
}

TEST_CASE("roboclaw: a version ends with a zero", "[roboclaw]") {
  const std::string text{"USB Roboclaw 2x15a v4.1.34\n\0", 28};
  const Bytes data{text.begin(), text.end()};
  Bytes reply = reply_of(0x87, Command::kReadVersion, data);
  CHECK(data_of(0x87, Command::kReadVersion, reply) == data);
  reply.insert(reply.begin(), 0xFF);
  CHECK(data_of(0x87, Command::kReadVersion, reply) == data);
  const Bytes endless{data.begin(), data.end() - 1};
  CHECK_FALSE(data_of(0x87, Command::kReadVersion, reply_of(0x87, Command::kReadVersion, endless)));
  CHECK_FALSE(data_of(0x87, Command::kReadVersion, {}));
  CHECK_FALSE(data_of(0x87, Command::kReadVersion, {0xFF, 0xFF, 0xFF}));
}

}  // namespace
}  // namespace lodesman::roboclaw
