// SPDX-License-Identifier: Apache-2.0
// Gets a NAV440 to say what is wanted, whatever it was set to and at whatever speed: finds its
// speed, silences it, asks who it is, sets packet and rate until its power goes, reads them back,
// and waits for the stream. A state at a time, driven by the frames that come and the time that
// passes; a request is sent again where its answer, known by type and field, fails to come. Part of
// the driver, on its thread; nothing blocks or allocates.
//
// Times: a speed is tried for 0.45 s. From when the unit would answer, the stream comes at the
// latest after a round of the four speeds (1.8 s, and what four connections take), seven requests
// of at most 1 s each, 0.1 s to settle and 0.1 s for a new speed. Where nothing is lost and the
// first speed is right, that is 0.1 s and six exchanges.
#pragma once

#include <array>
#include <cstdint>

#include "drivers/nav440/commands.h"
#include "drivers/nav440/framing.h"
#include "drivers/nav440/options.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman {

struct Nav440Identity {
  bool known = false;
  std::uint32_t serial = 0;
  std::array<char, 64> model{};  // as it says, cut; ends in zeros
  nav440::Version version;       // all 0 where it says none
};

namespace nav440 {

class StartUp {
 public:
  enum class State : std::uint8_t {
    kFinding,          // pings, at one speed after another
    kQuieting,         // asks it to say nothing by itself
    kSettling,         // lets what is under way arrive
    kIdentifying,      // asks who it is
    kAskingVersion,    // and of what version
    kSettingSpeed,     // asks it to speak faster
    kConfirmingSpeed,  // pings at that speed
    kSettingPacket,    // asks for packet and rate
    kReadingBack,      // asks what they are now
    kAwaitingStream,   // of the packets asked for
    kStreaming,        // the stream is there
    kResting,          // it will not be: tries again after a while
  };

  // Asks the stream for a connection at the speed that is tried first.
  StartUp(ByteStream& stream, const Nav440Options& options) noexcept;

  // There is a connection that was not there before.
  void connected(Time now) noexcept;
  // From the beginning, on the connection that there is, because of this.
  void begin_again(DeviceFault why, Time now) noexcept;
  void hear(const Nav440Frame& frame, Time now) noexcept;
  // Once a poll: what is due is sent or given up.
  void step(Time now) noexcept;

  [[nodiscard]] State state() const noexcept { return state_; }
  [[nodiscard]] bool streaming() const noexcept { return state_ == State::kStreaming; }
  // It has given the connection up and waits for the next one.
  [[nodiscard]] bool awaits_connection() const noexcept { return awaits_connection_; }
  [[nodiscard]] PacketType packet() const noexcept { return packet_; }
  [[nodiscard]] int baud() const noexcept { return speeds_[speed_]; }
  [[nodiscard]] std::uint64_t streams() const noexcept { return streams_; }  // begun so far
  [[nodiscard]] const Nav440Identity& identity() const noexcept { return identity_; }
  // Why there is no stream; of one that has not failed yet, kStarting.
  [[nodiscard]] DeviceFault fault() const noexcept;

 private:
  enum class Event : std::uint8_t { kNone, kAnswered, kRefused, kTimedOut };
  struct Rule;
  static const std::array<Rule, 12> kRules;

  [[nodiscard]] const Rule& rule() const noexcept;
  [[nodiscard]] Event event_of(const Nav440Frame& frame) noexcept;
  [[nodiscard]] Event event_of_fields(const Nav440Frame& frame) const noexcept;
  [[nodiscard]] Event event_of_identity(const Nav440Frame& frame) noexcept;
  void happen(Event event, Time now) noexcept;
  void enter(State state, Time now) noexcept;
  [[nodiscard]] bool takes_another_packet() noexcept;
  [[nodiscard]] bool needs_another_speed() const noexcept;
  void try_next_speed(Time now) noexcept;
  void speak_at(std::size_t speed) noexcept;
  void request(Time now) noexcept;
  void write_on(Time now) noexcept;

  ByteStream& stream_;
  Nav440Options options_;
  PacketType packet_;
  std::array<int, kNav440Speeds_baud.size()> speeds_{};  // the preferred one first
  std::size_t speed_ = 0;
  State state_ = State::kFinding;
  DeviceFault failure_ = DeviceFault::kNone;
  bool awaits_connection_ = true;
  int tries_left_ = 0;
  int speeds_tried_ = 0;  // without an answer, since one came
  int foreign_ = 0;       // frames of another family, since the beginning
  Time due_{};            // the next try, or the end of the last one
  Command outgoing_ = Command::ping();
  std::size_t sent_ = 0;  // of its bytes
  bool is_sending_ = false;
  std::uint64_t streams_ = 0;
  Nav440Identity identity_;
};

}  // namespace nav440
}  // namespace lodesman
