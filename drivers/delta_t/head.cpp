// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/head.h"

#include <algorithm>
#include <numbers>

namespace lodesman::delta_t {
namespace {

constexpr std::array<std::uint8_t, 11> kLiteralRanges_m{5,  10, 20,  30,  40, 50,
                                                        60, 80, 100, 150, 200};
constexpr double kPulseUnit_s = 10e-6;
constexpr double kTriggerUnit_s = 100e-6;
constexpr double kSwitchDelayUnit_s = 2e-3;
constexpr double kTurn_rad = 2.0 * std::numbers::pi;
constexpr double kTurnSteps = 65536.0;
constexpr std::uint8_t kHead = 0x10;
constexpr int kPointsShort = 8000;
constexpr int kPointsLong = 16000;
constexpr std::uint16_t kEchoes = 1000;

[[nodiscard]] double signed_turn_rad(std::uint16_t word) noexcept {
  return static_cast<std::int16_t>(word) * (kTurn_rad / kTurnSteps);
}

// Five kilohertz a step, but for the highest.
[[nodiscard]] double frequency_hz(std::uint8_t code) noexcept {
  constexpr std::uint8_t kHighest = 68;
  constexpr double kHighest_hz = 1.7e6;
  return code == kHighest ? kHighest_hz : 5000.0 * (code - 34);
}

[[nodiscard]] bool is_frequency(std::uint8_t code) noexcept {
  constexpr std::array<std::uint8_t, 7> kCodes{58, 68, 83, 84, 85, 86, 169};
  return std::find(kCodes.begin(), kCodes.end(), code) != kCodes.end();
}

[[nodiscard]] bool begins_switch(Bytes bytes) noexcept {
  return bytes.size() >= kSwitchBytes && bytes[0] == 0xFE && bytes[1] == 0x44 &&
         bytes[2] == kHead && bytes[26] == 0xFD && head_range_m(bytes[3]) > 0 &&
         (bytes[19] == 8 || bytes[19] == 16) && bytes[13] < bytes[19] && is_frequency(bytes[25]);
}

// Byte 110 of a file's record holds another number here; a reply's is always this.
[[nodiscard]] bool begins_reply(Bytes bytes) noexcept {
  if (bytes.size() < kReplyBytes || bytes[0] != 'I' || (bytes[1] != 'U' && bytes[1] != 'V') ||
      bytes[2] != 'X') {
    return false;
  }
  const int packets = bytes[1] == 'U' ? 8 : 16;
  return bytes[3] == kHead && bytes[5] < packets && word_at(bytes, 10) == kEchoes &&
         bytes[kReplyBytes - 1] == kReplyEnd;
}

}  // namespace

int head_range_m(std::uint8_t code) noexcept {
  switch (code) {
    case 201: return 250;
    case 202: return 300;
    default: break;
  }
  const bool is_literal =
      std::find(kLiteralRanges_m.begin(), kLiteralRanges_m.end(), code) != kLiteralRanges_m.end();
  return is_literal ? code : 0;
}

std::optional<SwitchCommand> switch_command_in(Bytes bytes) noexcept {
  if (!begins_switch(bytes)) {
    return std::nullopt;
  }
  SwitchCommand command;
  command.head = bytes[2];
  command.range_m = head_range_m(bytes[3]);
  command.nadir_offset_rad = signed_turn_rad(word_at(bytes, 5));
  command.gain_db = bytes[8];
  command.log_f = bytes[9];
  command.absorption_db_m = bytes[10] / 100.0;
  command.agc_threshold = bytes[11];
  command.packet = bytes[13];
  command.pulse_s = bytes[14] * kPulseUnit_s;
  command.trigger = bytes[16];
  command.trigger_delay_s = word_at(bytes, 17) * kTriggerUnit_s;
  command.data_points = bytes[19] * 1000;
  command.data_bits = bytes[20];
  command.attitude_command = bytes[21];
  command.run_mode = bytes[22];
  command.switch_delay_s = bytes[24] * kSwitchDelayUnit_s;
  command.frequency_hz = frequency_hz(bytes[25]);
  return command;
}

std::optional<HeadReply> head_reply_in(Bytes bytes) noexcept {
  if (!begins_reply(bytes)) {
    return std::nullopt;
  }
  HeadReply reply;
  reply.data_points = bytes[1] == 'U' ? kPointsShort : kPointsLong;
  reply.status = bytes[4];
  reply.packet = bytes[5];
  reply.firmware = bytes[6] & 0x0FU;
  reply.range_m = head_range_m(bytes[7]);
  reply.trigger_status = bytes[12];
  reply.attitude_sensor = bytes[13];
  reply.pitch_rad = signed_turn_rad(low_first_word_at(bytes, 14));
  reply.roll_rad = signed_turn_rad(low_first_word_at(bytes, 16));
  reply.heading_rad = low_first_word_at(bytes, 18) * (kTurn_rad / kTurnSteps);
  reply.timer_ticks = word_at(bytes, 20);
  reply.run_mode = bytes[22];
  reply.gain_db = bytes[24];
  reply.agc_bin = word_at(bytes, 25);
  reply.agc_most = word_at(bytes, 27);
  reply.echoes = bytes.subspan(kReplyHeaderBytes, kEchoes);
  return reply;
}

}  // namespace lodesman::delta_t
