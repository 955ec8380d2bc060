// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/commands.h"

#include "tests/support/catch.h"
#include "tests/unit/nav440/support.h"

namespace lodesman::testing {
namespace {

using nav440::Command;

[[nodiscard]] ByteList said(const Command& command) {
  return {command.bytes().begin(), command.bytes().end()};
}

TEST_CASE("nav440 commands: each is the vector's, to the byte", "[nav440]") {
  CHECK(said(Command::ping()) == vector_bytes("A-1"));
  CHECK(said(Command::get_packet(nav440::kA1)) == vector_bytes("A-3"));
  CHECK(said(Command::get_packet(nav440::kIdentity)) == vector_bytes("A-4"));
  CHECK(said(Command::get_packet(nav440::kVersion)) == vector_bytes("A-5"));
  CHECK(said(Command::get_packet(nav440::kSelfTest)) == vector_bytes("A-6"));
  CHECK(said(Command::set_fields({{1, 2}})) == vector_bytes("A-7"));
  CHECK(said(Command::set_fields({{1, 0}})) == vector_bytes("A-9"));
  CHECK(said(Command::set_fields({{3, nav440::kA1}})) == vector_bytes("A-10"));
  CHECK(said(Command::set_fields({{1, 2}, {3, nav440::kA1}})) == vector_bytes("A-11"));
  CHECK(said(Command::get_fields({1, 2, 3})) == vector_bytes("A-12"));
  CHECK(said(Command::write_fields({{1, 4}})) == vector_bytes("A-14"));
  CHECK(said(Command::read_fields({1, 2})) == frame_of("RF", {2, 0, 1, 0, 2}));
}

TEST_CASE("nav440 commands: the largest list of fields fits", "[nav440]") {
  const Command command =
      Command::set_fields({{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}, {6, 0}, {7, 0}, {8, 0xFFFF}});
  CHECK(command.bytes().size() == 40);
  CHECK(frames_in(command.bytes()).size() == 1);
}

TEST_CASE("nav440 commands: speeds have the manual's codes", "[nav440]") {
  CHECK(nav440::speed_code(9600) == 0);
  CHECK(nav440::speed_code(19200) == 1);
  CHECK(nav440::speed_code(38400) == 2);
  CHECK(nav440::speed_code(57600) == 3);
  CHECK_FALSE(nav440::speed_code(115200).has_value());
}

}  // namespace
}  // namespace lodesman::testing
