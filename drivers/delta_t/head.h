// SPDX-License-Identifier: Apache-2.0
// What goes between a Delta T head and the program that forms its beams, for `lodesman decode`
// alone: how the 8000 or 16000 bytes of a ping make beams is not public, so that no driver of ours
// speaks with a head. The link has no check; what is looked at is that each byte which can have few
// values has one of them. Pure; any thread.
//
// Sources: three independent drivers, which agree but where noted.
#pragma once

#include <array>
#include <optional>

#include "drivers/delta_t/bytes.h"

namespace lodesman::delta_t {

inline constexpr std::size_t kSwitchBytes = 27;
inline constexpr std::size_t kReplyBytes = 1033;
inline constexpr std::size_t kReplyHeaderBytes = 32;
inline constexpr std::uint8_t kReplyEnd = 0xFC;

struct SwitchCommand {
  std::uint8_t head = 0;          // [-] its number
  int range_m = 0;                // [m]
  double nadir_offset_rad = 0.0;  // [rad] [-pi, pi)
  int gain_db = 0;                // [dB]
  std::uint8_t log_f = 0;
  double absorption_db_m = 0.0;  // [dB/m]
  std::uint8_t agc_threshold = 0;
  std::uint8_t packet = 0;       // [-] of the ping's
  double pulse_s = 0.0;          // [s]
  std::uint8_t trigger = 0;      // [-] bit 0 edge, 1 enable
  double trigger_delay_s = 0.0;  // [s]
  int data_points = 0;           // [-] 8000 or 16000
  std::uint8_t data_bits = 0;
  std::uint8_t attitude_command = 0;
  std::uint8_t run_mode = 0;    // [-] bit 0 transmit off, 1 TVG off, 4 auto gain
  double switch_delay_s = 0.0;  // [s]
  double frequency_hz = 0.0;    // [Hz]
};

// The first 27 bytes; nothing where they are no switch command.
[[nodiscard]] std::optional<SwitchCommand> switch_command_in(Bytes bytes) noexcept;

struct HeadReply {
  int data_points = 0;        // [-] 8000 (IUX) or 16000 (IVX)
  std::uint8_t status = 0;    // [-] bit 0 switch error, 2 time-out of the attitude sensor,
                              //     6 switches accepted, 7 characters lost
  std::uint8_t packet = 0;    // [-]
  std::uint8_t firmware = 0;  // [-]
  int range_m = 0;            // [m]
  std::uint8_t trigger_status = 0;
  std::uint8_t attitude_sensor = 0;  // [-] 0 none, 1 837A, 2 837B, 5 837
  double pitch_rad = 0.0;            // [rad] the low byte first, as three drivers of four read it
  double roll_rad = 0.0;             // [rad]
  double heading_rad = 0.0;          // [rad] [0, 2 pi)
  std::uint16_t timer_ticks = 0;
  std::uint8_t run_mode = 0;
  int gain_db = 0;  // [dB]
  std::uint16_t agc_bin = 0, agc_most = 0;
  Bytes echoes;  // 1000, of elements, not of beams

  [[nodiscard]] bool switch_error() const noexcept { return (status & 1U) != 0; }
};

// The first 1033 bytes, of a stream that may come in any pieces: whoever reads collects them.
// Nothing where they are no reply.
[[nodiscard]] std::optional<HeadReply> head_reply_in(Bytes bytes) noexcept;

// [m] of the byte that stands for a range; 0: there is none.
[[nodiscard]] int head_range_m(std::uint8_t code) noexcept;

}  // namespace lodesman::delta_t
