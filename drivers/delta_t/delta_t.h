// SPDX-License-Identifier: Apache-2.0
// A Delta T behind the maker's program, which forms its beams and sends a datagram a ping: 83B, an
// image, or 83P, a profile. Made at start-up; polled by one thread, and what it says is of the last
// poll.
//
// A ping is stamped with the time at which it was sent: its arrival, less the latencies that its
// header gives (data less ping), and never later than its arrival. Stamps and numbers rise. Of
// several that wait the newest is given; what waited while nobody polled is no news. Each is
// decoded by its own header, whatever was asked for.
//
// What is asked for goes to the program after each datagram until the headers show it, and once a
// second after that and in silence: gain does not show, and a program that is started again has
// forgotten it.
#pragma once

#include <array>
#include <memory>

#include "drivers/delta_t/settings.h"
#include "drivers/hal/devices.h"
#include "drivers/stream/datagram_socket.h"

namespace lodesman {

struct DeltaTCounts {
  std::uint64_t datagrams = 0;       // [-] that came
  std::uint64_t images = 0;          // [-] given
  std::uint64_t profiles = 0;        // [-] given
  std::uint64_t unknown_tags = 0;    // [-] datagrams of other kinds, left out
  std::uint64_t wrong_lengths = 0;   // [-] refused: not as long as they say
  std::uint64_t implausible = 0;     // [-] refused: geometry, range or sound speed cannot be
  std::uint64_t overtaken = 0;       // [-] whole, but a newer one came at the same poll
  std::uint64_t stale = 0;           // [-] that had waited while nobody polled
  std::uint64_t future_stamps = 0;   // [-] pings whose latencies would have them sent after arrival
  std::uint64_t centimetres = 0;     // [-] profiles with a resolution in the wrong unit
  std::uint64_t unusual_beams = 0;   // [-] pings whose beams lie otherwise than their sector says
  std::uint64_t control_frames = 0;  // [-] sent
  delta_t::PingOrderCounts order;
};

class DeltaT final : public ImagingSonar {
 public:
  static constexpr Duration kControlPeriod = std::chrono::seconds{1};
  // Nobody polled for so long: what waits is of unknown age.
  static constexpr Duration kStall = std::chrono::milliseconds{500};
  // Without a ping for so long, or for three of its own periods where that is more, it is silent.
  static constexpr Duration kSilence = std::chrono::seconds{3};
  // Other settings than those asked for, for so long, are what it refuses to change.
  static constexpr Duration kEchoPatience = std::chrono::seconds{3};

  DeltaT(DatagramSocket& socket, const DeltaTSettings& settings);

  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override;

  [[nodiscard]] DeltaTCounts counts() const noexcept;
  // Whether the last ping was as asked for, as far as it shows.
  [[nodiscard]] bool is_as_asked() const noexcept { return is_as_asked_; }

 private:
  static constexpr std::size_t kBuffer_bytes = 65536;
  using Buffer = std::array<std::uint8_t, kBuffer_bytes>;

  void drain(Time now, bool stalled) noexcept;
  void hear(std::size_t size, Time now) noexcept;
  void refuse(delta_t::Refusal refusal) noexcept;
  void look_at(const delta_t::Header& header, Time now) noexcept;
  void ask(Time now) noexcept;
  [[nodiscard]] ReadStatus give(SonarPing& out) noexcept;
  [[nodiscard]] Time captured(const delta_t::Header& header) noexcept;

  DatagramSocket& socket_;
  DeltaTSettings settings_;
  std::array<std::uint8_t, delta_t::kControlBytes> frame_;
  // One to receive into, one for the ping that waits to be given.
  std::unique_ptr<Buffer> incoming_ = std::make_unique<Buffer>();
  std::unique_ptr<Buffer> held_ = std::make_unique<Buffer>();
  std::size_t held_bytes_ = 0;  // 0: none waits
  Time held_arrival_{};
  std::uint64_t held_number_ = 0;

  delta_t::PingOrder order_;
  Time started_{};  // the first poll
  Time polled_{};
  Time now_{};          // of the last poll
  Time heard_{};        // the last whole ping; zero: none yet
  Time asked_{};        // the last control frame
  Time stamped_{};      // the last ping that was given
  Time as_asked_at_{};  // when the headers last showed what was asked for, or the first one came
  Duration silence_ = kSilence;
  bool is_as_asked_ = false;
  bool is_unusual_ = false;
  bool is_corrupt_ = false;  // something was refused since that was last told
  int implausible_in_a_row_ = 0;
  DeltaTCounts counts_;
};

}  // namespace lodesman
