// SPDX-License-Identifier: Apache-2.0
// Two motors behind a RoboClaw in packet serial mode; docs/wire/roboclaw.md says how its owner has
// to set it. It is asked who it is and stopped, its time-out is set and read back, it is left alone
// for longer than that and must then report both motors stopped. That shows that it holds the
// setting and does not move by itself; it does not show that running motors stop, since nothing but
// stop is commanded before the box is taken for ready. The duty of both is written in every call
// but those in which the battery or the time-out is read. Nothing is said outside command(). One
// thread: its task's.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "drivers/hal/device_address.h"
#include "drivers/hal/devices.h"
#include "drivers/hal/thrust_shape.h"
#include "drivers/roboclaw/exchange.h"

namespace lodesman {

struct RoboClawOptions {
  std::uint8_t address = roboclaw::kFirstAddress;      // [-] [128, 135]
  Duration time_out = std::chrono::milliseconds{500};  // [ns] in tenths of a second
  bool left_reversed = false;
  bool right_reversed = false;
  bool swap = false;  // the left thruster is the second motor
  // After each start the first command that is taken is a neutral one: whoever replugs a box does
  // not find it at full thrust. Without it what is commanded runs as soon as the box is ready.
  bool neutral_first = true;
};

// The settings of an address "roboclaw:/dev/...?address=128", and what they come to. Throws
// StartupError.
[[nodiscard]] std::vector<std::string_view> roboclaw_settings();
[[nodiscard]] RoboClawOptions roboclaw_options(const DeviceAddress& address);

class RoboClaw final : public ThrusterPair {
 public:
  enum class State : std::uint8_t {
    kDisconnected,    // there is no connection
    kIdentifying,     // asked for its version
    kStopping,        // told to stop
    kSetting,         // told its time-out
    kReadingTimeOut,  // asked for it
    kPausing,         // nothing is said for the time-out and a half
    kReadingDuties,   // whether both motors stand still
    kReadingStatus,
    kHolding,  // stopped at each step, until neutral is commanded
    kReady,
    kRegaining,  // an acknowledge is missing: stopped, until it is certain what was understood
    kResting,    // at fault: stopped, then all over again
  };
  struct Counts {
    std::uint64_t duties = 0;        // written whole while ready
    std::uint64_t acknowledged = 0;  // of them, each by an acknowledge that can be no other's
    std::uint64_t lost = 0;          // acknowledges and replies
    std::uint64_t short_writes = 0;
    std::uint64_t resets = 0;
    std::uint64_t starts = 0;  // how often it came to be ready
  };

  // Throws StartupError where the options cannot be.
  RoboClaw(ByteStream& stream, const RoboClawOptions& options, const ThrustShapeOptions& shape);

  // While an exchange is in flight, for Exchange::kReplyWait at most, a command waits for the next
  // call, but for neutral, which goes out at once.
  [[nodiscard]] CommandStatus command(ThrustCommand command, Time now) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override { return fault_; }
  [[nodiscard]] BatteryReading battery() const noexcept override { return battery_; }

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] const Counts& counts() const noexcept { return counts_; }
  // As the box says it, of the start-up: bits whose meaning depends on its firmware.
  [[nodiscard]] std::uint32_t status_word() const noexcept { return status_word_; }
  [[nodiscard]] std::string_view version() const noexcept {
    return {version_.data(), version_length_};
  }

  // Battery and time-out in turn.
  static constexpr Duration kReadPeriod = std::chrono::milliseconds{400};
  static constexpr Duration kRest = std::chrono::seconds{3};
  static constexpr int kMaxLost = 3;  // in a row
  // So long after it was due an acknowledge may still come out of turn.
  static constexpr Duration kLateLimit = 3 * roboclaw::Exchange::kReplyWait;

 private:
  struct Duties {
    std::int16_t first = 0;
    std::int16_t second = 0;

    friend bool operator==(const Duties&, const Duties&) = default;
  };

  // Steps of command().
  [[nodiscard]] bool follow_connection(Time now) noexcept;
  void lose_connection(Time now) noexcept;
  [[nodiscard]] CommandStatus step(roboclaw::Outcome outcome, const ThrustCommand& command,
                                   Time now) noexcept;

  // What is done in each state.
  void start_up(roboclaw::Outcome outcome, Time now) noexcept;
  void pause(Time now) noexcept;
  [[nodiscard]] CommandStatus serve(roboclaw::Outcome outcome, const ThrustCommand& command,
                                    Time now) noexcept;
  [[nodiscard]] CommandStatus regain(roboclaw::Outcome outcome, const ThrustCommand& command,
                                     Time now) noexcept;
  void await_silence(Time now) noexcept;
  void rest(Time now) noexcept;

  void ask_again(Time now) noexcept;
  [[nodiscard]] State answered(State then, Time now) noexcept;
  void read_back(Time now) noexcept;
  [[nodiscard]] bool read_is_due(const ThrustCommand& command, Time now) const noexcept;
  [[nodiscard]] CommandStatus speak(const ThrustCommand& command, Time now) noexcept;
  void stop_and_regain(Time now) noexcept;
  void stop_unheard(Time now) noexcept;

  void enter(State state, Time now) noexcept;
  void start_over(Time now) noexcept;
  void give_up(DeviceFault why, Time now) noexcept;
  [[nodiscard]] bool lost_once_more() noexcept;
  // Of the start-up: what failed before is told until the box is ready.
  void tell(DeviceFault starting) noexcept;

  [[nodiscard]] bool read(roboclaw::Command command, Time now) noexcept;
  [[nodiscard]] bool drive(const Duties& duties, Time now) noexcept;
  [[nodiscard]] Duties stopped(Time now) noexcept;
  [[nodiscard]] Duties shaped(const ThrustCommand& command, Time now) noexcept;
  [[nodiscard]] std::uint8_t time_out_units() const noexcept;

  ByteStream& stream_;
  RoboClawOptions options_;
  ThrustShape left_;
  ThrustShape right_;
  roboclaw::Exchange exchange_;

  State state_ = State::kDisconnected;
  Time since_{};                    // when that state was entered
  State served_ = State::kHolding;  // what kRegaining leads back to
  std::uint64_t connection_ = 0;
  DeviceFault fault_ = DeviceFault::kStarting;
  DeviceFault failed_ = DeviceFault::kNone;  // why the start-up was begun anew

  bool identified_ = false;          // on this connection
  std::uint64_t strays_before_ = 0;  // of the exchange's, when the start-up began
  int lost_ = 0;                     // acknowledges and replies, in a row
  int reads_lost_ = 0;               // of those beside the duties

  Duties sent_{};              // by the last whole write
  Time spoke_at_{};            // when that was
  Time read_at_{};             // when something was last read beside the duties
  bool read_battery_ = false;  // the last time; then it is the time-out's turn
  BatteryReading battery_;
  std::uint32_t status_word_ = 0;
  std::array<char, roboclaw::kMaxReplyBytes> version_{};
  std::size_t version_length_ = 0;
  Counts counts_;
};

}  // namespace lodesman
