// SPDX-License-Identifier: Apache-2.0
// Two thrusters behind a Pololu Maestro. It is asked who it is, then seen to stop by itself, then
// held at neutral, and only then obeys; docs/wire/maestro.md says how its owner has to set it. Both
// channels are written in every call and their positions read back in the same write, the error
// register once a second. Nothing is said outside command(), since whatever is said to the box sets
// its time-out anew. One thread: its task's.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drivers/hal/device_address.h"
#include "drivers/hal/devices.h"
#include "drivers/hal/thrust_shape.h"
#include "drivers/maestro/conversation.h"

namespace lodesman {

struct MaestroOptions {
  std::uint8_t left_channel = 0;   // [-] [0, 23]
  std::uint8_t right_channel = 1;  // [-] [0, 23] another one
  bool left_reversed = false;      // ahead is the shorter pulse
  bool right_reversed = false;
  double neutral_us = 1500.0;  // [us] [1000, 2000] the box's home position too
  double range_us = 476.25;    // [us] [50, 1000] from neutral to full thrust
  // [ns] the box's setting, 0.3 s to 0.9 s; it is proved, not set.
  Duration time_out = std::chrono::milliseconds{500};
  // [ns] of neutral pulses before the first command: a speed controller wakes up to them.
  Duration hold_neutral = std::chrono::seconds{2};
  bool crc = false;  // the box's setting "Enable CRC"
  // After each start the first command that is taken is a neutral one: whoever replugs a box does
  // not find it at full thrust. Without it what is commanded runs as soon as the box is ready.
  bool neutral_first = true;
};

// The settings of an address "maestro:/dev/...?left=0", and what they come to. Throws StartupError.
[[nodiscard]] std::vector<std::string_view> maestro_settings();
[[nodiscard]] MaestroOptions maestro_options(const DeviceAddress& address);

class Maestro final : public ThrusterPair {
 public:
  enum class State : std::uint8_t {
    kDisconnected,  // there is no connection
    kRecalling,     // a proof is on record: nothing is said until the box must have stopped
    kConfirming,    // whether it did
    kIdentifying,   // asked for its errors, and for nothing else until it answers
    kPausing,       // nothing is said for the time-out and a half
    kReadingBack,   // whether it timed out, and went to neutral by itself
    kHolding,       // neutral, until the speed controllers are awake
    kReady,
    kResting,  // at fault: neutral, then all over again
  };
  struct Counts {
    std::uint64_t commands = 0;      // written whole while ready
    std::uint64_t short_writes = 0;  // of which the line did not take all
    std::uint64_t lost_answers = 0;
    std::uint64_t error_reports = 0;  // answers with an error bit that we did not cause
    std::uint64_t resets = 0;
    std::uint64_t starts = 0;   // how often it came to be ready
    std::uint64_t recalls = 0;  // of them, by a proof on record
  };

  // Throws StartupError where the options cannot be.
  Maestro(ByteStream& stream, const MaestroOptions& options, const ThrustShapeOptions& shape);

  [[nodiscard]] CommandStatus command(ThrustCommand command, Time now) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override { return fault_; }

  // A proof on record stands for the first connection, if that is of the same power-up and the box
  // tells that it stopped by itself since `last_command`. Then it is not proved again, nor neutral
  // held for long: its pulses never ended.
  void recall(const BoxProof& proof, Time last_command) noexcept override;
  [[nodiscard]] BoxProof proof() const noexcept override { return proof_; }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  [[nodiscard]] std::uint64_t stray_bytes() const noexcept { return talk_.stray_bytes(); }

  static constexpr Duration kErrorPeriod = std::chrono::milliseconds{800};
  static constexpr Duration kRest = std::chrono::seconds{3};
  static constexpr int kMaxLost = 3;  // in a row
  // So many reports of errors within kErrorWindow are a fault.
  static constexpr std::size_t kMaxErrors = 3;
  static constexpr Duration kErrorWindow = std::chrono::seconds{10};

 private:
  // Quarters of a microsecond, of both channels.
  struct Pulses {
    std::uint16_t left = 0;
    std::uint16_t right = 0;
  };
  // The question that is open, or was answered last.
  struct Question {
    bool errors = false;        // the register was asked for too
    bool silence_ours = false;  // we had been silent for the box's time-out before
    Pulses sent{};              // what the positions have to be
  };
  // What was last found out about the positions.
  enum class Doubt : std::uint8_t {
    kNone,
    kWrong,  // far from what was sent
    kReset,  // that, and as they are after a reset
  };

  // Steps of command().
  [[nodiscard]] bool follow_connection(Time now) noexcept;
  void lose_connection(Time now) noexcept;
  [[nodiscard]] CommandStatus step(maestro::Answer answer, const ThrustCommand& command,
                                   Time now) noexcept;

  // What is done in each state.
  [[nodiscard]] bool proof_is_on_record() noexcept;
  void await_time_out(Time now) noexcept;
  void confirm(maestro::Answer answer, Time now) noexcept;
  void begin_holding(const BoxProof& proof, Duration for_so_long, Time now) noexcept;
  void identify(maestro::Answer answer, Time now) noexcept;
  void pause(Time now) noexcept;
  void read_back(maestro::Answer answer, Time now) noexcept;
  [[nodiscard]] CommandStatus serve(maestro::Answer answer, const ThrustCommand& command,
                                    Time now) noexcept;
  void rest(Time now) noexcept;

  // What an answer means while neutral is held and while commands are taken.
  void judge(maestro::Answer answer, Time now) noexcept;
  void judge_positions(const Pulses& found, Time now) noexcept;
  void count_error(Time now) noexcept;

  void enter(State state, Time now) noexcept;
  void start_over(Time now) noexcept;
  void give_up(DeviceFault why, Time now) noexcept;
  // One more answer is lost; true where it was the last that may be.
  [[nodiscard]] bool lost_once_more() noexcept;
  // Of the start-up: what failed before is told until the box is ready.
  void tell(DeviceFault starting) noexcept;

  [[nodiscard]] maestro::Message next_questions(Time now) noexcept;
  void add_errors(maestro::Message& message) const noexcept;
  void add_positions(maestro::Message& message) const noexcept;
  [[nodiscard]] bool write(maestro::Message message, const Pulses& pulses, Time now) noexcept;
  [[nodiscard]] maestro::Packet checked(const maestro::Packet& packet) const noexcept;

  [[nodiscard]] Pulses stopped(Time now) noexcept;
  [[nodiscard]] Pulses shaped(const ThrustCommand& command, Time now) noexcept;
  [[nodiscard]] std::uint16_t pulse(double share) const noexcept;
  [[nodiscard]] bool is_far(std::uint16_t found, std::uint16_t sent) const noexcept;
  [[nodiscard]] bool is_home(std::uint16_t found) const noexcept;
  [[nodiscard]] bool is_neutral_pulse(std::uint16_t found) const noexcept;

  ByteStream& stream_;
  MaestroOptions options_;
  ThrustShape left_;
  ThrustShape right_;
  maestro::Conversation talk_;

  State state_ = State::kDisconnected;
  Time since_{};  // when that state was entered
  std::uint64_t connection_ = 0;
  DeviceFault fault_ = DeviceFault::kStarting;
  DeviceFault failed_ = DeviceFault::kNone;  // why the start-up was begun anew

  BoxProof recalled_;    // until it was looked at
  Time last_command_{};  // of whoever was here before
  BoxProof proof_;       // of this connection
  Duration hold_{};      // neutral is held for so long

  bool identified_ = false;         // on this connection
  bool heard_ = false;              // bytes that no Maestro would say, since the start-up began
  std::uint64_t strays_heard_ = 0;  // of the conversation's, when it was last looked at
  int lost_ = 0;                    // answers, in a row

  Pulses sent_{};                               // by the last whole write
  Time spoke_at_{};                             // when that was
  bool silence_ours_ = false;                   // since the register was last asked for
  Question question_{};                         //
  Time errors_asked_at_{};                      // when the register was last asked for
  Doubt doubt_ = Doubt::kNone;                  //
  std::array<Time, kMaxErrors> error_times_{};  // of the last reports, a ring
  std::size_t errors_ = 0;                      // since the start-up
  Counts counts_;
};

}  // namespace lodesman
