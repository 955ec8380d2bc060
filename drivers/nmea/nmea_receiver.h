// SPDX-License-Identifier: Apache-2.0
// A satellite receiver that speaks NMEA 0183, on a line of bytes; polled by one thread, and what it
// says is of the last poll. It is listened to and told nothing.
//
// A fix is an epoch of RMC and GGA (or of the one that there is) that both call valid and that
// agree on the place: a checksum of eight bits alone lets damage pass. The qualities "reckoned",
// "entered by hand" and "simulated" are no fixes. Its stamp is by fix_stamp.h, its accuracy by
// fix_check.h. What cannot be (a place that is nowhere, sentences that disagree, a position that is
// frozen though the boat moves) is kCorrupt, a receiver that has no fix is kNothingNew, with
// kNoFix. Nothing for kSilence is kNoAnswer.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "drivers/hal/devices.h"
#include "drivers/hal/fix_outlet.h"
#include "drivers/hal/fix_stamp.h"
#include "drivers/nmea/epochs.h"
#include "drivers/nmea/framing.h"
#include "drivers/nmea/options.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman {

struct NmeaCounts {
  NmeaFramingCounts framing;
  FixOutletCounts given;
  std::uint64_t malformed = 0;  // [-] sentences whose checksum holds, that say what cannot be
  std::uint64_t voids = 0;      // [-] epochs without a fix, by the receiver's own word
  std::uint64_t nowhere = 0;    // [-] at latitude and longitude 0, or that disagree with themselves
  std::uint64_t repeated = 0;   // [-] of a time that was given already, or before it
};

class NmeaReceiver final : public PositionSensor {
 public:
  static constexpr Duration kSilence = std::chrono::seconds{3};

  NmeaReceiver(ByteStream& stream, NmeaOptions options) noexcept
      : stream_{stream}, options_{options} {}

  [[nodiscard]] Reading<PositionFix> poll(Time now) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override;

  [[nodiscard]] NmeaCounts counts() const noexcept;

 private:
  void look_at_connection(Time now) noexcept;
  void read_on(Time now) noexcept;
  [[nodiscard]] bool refill(Time now) noexcept;
  void hear(std::string_view sentence, Time now) noexcept;
  void take_part(bool has_fix, Time now) noexcept;
  void take_epoch(Time now) noexcept;
  void judge(const nmea::Epoch& epoch) noexcept;
  void give(PositionFix fix, const nmea::Epoch& epoch) noexcept;
  [[nodiscard]] std::uint64_t damaged() const noexcept;

  static constexpr std::size_t kChunk = 16;  // stamps are as fine as so many bytes

  ByteStream& stream_;
  NmeaOptions options_;
  NmeaFraming framing_;
  nmea::Epochs epochs_;
  FixStamp stamp_;
  FixOutlet outlet_;
  std::uint64_t connection_ = 0;
  std::array<std::uint8_t, kChunk> chunk_{};
  std::size_t chunk_size_ = 0;
  std::size_t chunk_at_ = 0;
  std::size_t left_ = 0;  // bytes that this poll may still read
  Time arrived_{};        // the chunk
  Time begun_{};          // the first byte of the sentence under way
  Time heard_{};          // the last sentence of a fix, or the connection
  bool any_heard_ = false;
  NmeaCounts counts_;
};

}  // namespace lodesman
