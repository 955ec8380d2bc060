// SPDX-License-Identifier: Apache-2.0
// A Crossbow NAV440, or a sister of its family, on a line of bytes: true heading from its packets
// A0, A1 (magnetic, with the declination that it is told) or N0, N1 (true). Made at start-up;
// polled by one thread, and what it says is of the last poll.
//
// A sample's stamp is when the packet's last byte arrived, less what the line and the adapter are
// known to take, smoothed by the device's own time: batches of an adapter do not show. It is never
// later than the arrival, and rises from one to the next. A packet is believed by plausibility.h;
// one that is not, or is of a unit that fails its own test or is frozen, is kCorrupt. A failed test
// is so with the packet that says so; a warning alone stops nothing.
//
// Without a whole packet for a second (three periods of a slow one) the start-up begins again, as
// it does where nobody polled for a second: what has waited since then is not news.
#pragma once

#include <optional>

#include "drivers/hal/devices.h"
#include "drivers/nav440/fix_maker.h"
#include "drivers/nav440/framing.h"
#include "drivers/nav440/frozen_watch.h"
#include "drivers/nav440/options.h"
#include "drivers/nav440/plausibility.h"
#include "drivers/nav440/start_up.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman {

struct Nav440Counts {
  Nav440FramingCounts framing;
  std::uint64_t samples = 0;           // [-] given
  std::uint64_t implausible = 0;       // [-] packets whose check holds, that follow from nothing
  std::uint64_t self_test_failed = 0;  // [-] packets that said so
  std::uint64_t frozen = 0;            // [-] packets of a frozen unit
  std::uint64_t same_stamp = 0;        // [-] samples left out: not later than the one before
  std::uint64_t streams = 0;           // [-] that began
};

class Nav440 final : public HeadingSensor {
 public:
  // fixes: where the places of N0 and N1 go, for a Nav440Position; nullptr: nobody wants them. It
  // must outlive the driver. Throws StartupError where the options do not fit each other.
  Nav440(ByteStream& stream, Nav440Options options, Nav440FixRelay* fixes = nullptr);

  [[nodiscard]] Reading<Attitude> poll(Time now) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override;

  [[nodiscard]] const Nav440Identity& identity() const noexcept { return start_up_.identity(); }
  [[nodiscard]] Nav440Counts counts() const noexcept;
  [[nodiscard]] nav440::StartUp::State state() const noexcept { return start_up_.state(); }
  [[nodiscard]] bool streaming() const noexcept { return start_up_.streaming(); }
  // [Bd] that it speaks now; means nothing where the line has no speed.
  [[nodiscard]] int baud() const noexcept { return start_up_.baud(); }
  // That its heading comes from, where it streams.
  [[nodiscard]] nav440::PacketType packet() const noexcept { return start_up_.packet(); }

 private:
  [[nodiscard]] Reading<Attitude> poll_unit(Time now) noexcept;
  void look_at_connection(Time now) noexcept;
  void read_on(Time now) noexcept;
  void hear(const Nav440Frame& frame, Time now) noexcept;
  void begin_stream() noexcept;
  void take(const Nav440Frame& frame) noexcept;
  void refuse(std::uint64_t& count) noexcept;
  void judge(const Nav440Frame& frame, const nav440::HeadingPacket& packet, Time arrived) noexcept;
  [[nodiscard]] Duration on_the_line(const Nav440Frame& frame) const noexcept;
  [[nodiscard]] Duration silence_limit() const noexcept;

  ByteStream& stream_;
  Nav440Options options_;
  Nav440Framing framing_;
  nav440::StartUp start_up_;
  nav440::Plausibility plausibility_;
  nav440::FrozenWatch frozen_watch_;
  nav440::FixMaker fix_maker_;
  std::uint64_t connection_ = 0;
  std::uint64_t stream_seen_ = 0;  // the start-up's count of them
  Time polled_{};
  Time heard_{};    // the last whole packet of the stream
  Time arrived_{};  // the last bytes
  Time stamped_{};  // the last sample
  std::optional<Attitude> ready_;
  bool is_corrupt_ = false;  // bytes or packets since that was last told
  DeviceFault ails_ = DeviceFault::kNone;
  int implausible_in_a_row_ = 0;
  int implausible_weight_ = 0;
  int of_another_stream_ = 0;  // packets in a row
  Nav440Counts counts_;
};

}  // namespace lodesman
