// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/commands.h"

#include "drivers/nav440/framing.h"
#include "mid_level/base/check.h"

namespace lodesman::nav440 {
namespace {

constexpr std::size_t kPreambleSize = 2;

}  // namespace

Command::Command(PacketType type, std::size_t payload) noexcept {
  append(0x55);
  append(0x55);
  append_word(type);
  append(static_cast<std::uint8_t>(payload));
}

void Command::append_word(std::uint16_t word) noexcept {
  append(static_cast<std::uint8_t>(word >> 8U));
  append(static_cast<std::uint8_t>(word & 0xFFU));
}

Command& Command::closed() noexcept {
  append_word(nav440_crc(bytes().subspan(kPreambleSize)));
  return *this;
}

Command Command::ping() noexcept { return Command{kPing, 0}.closed(); }

Command Command::get_packet(PacketType wanted) noexcept {
  Command command{kGetPacket, 2};
  command.append_word(wanted);
  return command.closed();
}

Command Command::of_fields(PacketType type, std::initializer_list<Field> fields) noexcept {
  LODESMAN_CHECK(fields.size() <= kMostFields);
  Command command{type, 1 + 4 * fields.size()};
  command.append(static_cast<std::uint8_t>(fields.size()));
  for (const Field& field : fields) {
    command.append_word(field.id);
    command.append_word(field.value);
  }
  return command.closed();
}

Command Command::of_ids(PacketType type, std::initializer_list<std::uint16_t> ids) noexcept {
  LODESMAN_CHECK(ids.size() <= kMostFields);
  Command command{type, 1 + 2 * ids.size()};
  command.append(static_cast<std::uint8_t>(ids.size()));
  for (const std::uint16_t id : ids) {
    command.append_word(id);
  }
  return command.closed();
}

Command Command::set_fields(std::initializer_list<Field> fields) noexcept {
  return of_fields(kSetFields, fields);
}
Command Command::write_fields(std::initializer_list<Field> fields) noexcept {
  return of_fields(kWriteFields, fields);
}
Command Command::get_fields(std::initializer_list<std::uint16_t> ids) noexcept {
  return of_ids(kGetFields, ids);
}
Command Command::read_fields(std::initializer_list<std::uint16_t> ids) noexcept {
  return of_ids(kReadFields, ids);
}

std::optional<std::uint16_t> speed_code(int baud) noexcept {
  switch (baud) {
    case 9600: return 0;
    case 19200: return 1;
    case 38400: return 2;
    case 57600: return 3;
    default: return std::nullopt;
  }
}

}  // namespace lodesman::nav440
