// SPDX-License-Identifier: Apache-2.0
// A satellite receiver behind gpsd, over its JSON (protocol 3) on a line of bytes; polled by one
// thread, and what it says is of the last poll.
//
// gpsd says nothing when its receiver is silent or gone, and may itself be gone without a word. So
// time is kept here: without a fix for kSilence it is kNoAnswer, or what gpsd last told of its
// receivers. Without a byte for kSilence gpsd is asked for its devices, which a living one answers
// at once; without an answer for as long, the connection is given up and made anew.
//
// A fix is a TPV of mode 2 or 3 with a time and a place, each time once. Its accuracy is by its
// status and the HDOP of the last SKY (fix_check.h), for gpsd's own estimate knows no RTK. Statuses
// that are reckoned, simulated or time alone are no fixes. Of several receivers the first that
// speaks is listened to, until it is silent.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "drivers/gpsd/options.h"
#include "drivers/gpsd/reports.h"
#include "drivers/hal/devices.h"
#include "drivers/hal/fix_outlet.h"
#include "drivers/hal/fix_stamp.h"
#include "drivers/stream/byte_stream.h"

namespace lodesman {

struct GpsdCounts {
  std::uint64_t reports = 0;  // [-] lines that are whole objects
  std::uint64_t broken = 0;   // [-] lines that are not, or too long
  FixOutletCounts given;
  std::uint64_t voids = 0;         // [-] TPV without a fix
  std::uint64_t without_time = 0;  // [-] TPV with a fix, and no time or place
  std::uint64_t repeated = 0;      // [-] of a time that was given already, or before it
  std::uint64_t nowhere = 0;       // [-] at latitude and longitude 0
  std::uint64_t of_others = 0;     // [-] TPV of another receiver
  std::uint64_t given_up = 0;      // [-] connections to a gpsd that did not answer
};

class GpsdReceiver final : public PositionSensor {
 public:
  static constexpr Duration kSilence = std::chrono::seconds{3};
  static constexpr Duration kSkyLasts = std::chrono::seconds{10};
  static constexpr std::size_t kLongestLine = 10240;  // gpsd's own limit of a report

  GpsdReceiver(ByteStream& stream, GpsdOptions options);

  [[nodiscard]] Reading<PositionFix> poll(Time now) noexcept override;
  [[nodiscard]] DeviceFault fault() const noexcept override;

  [[nodiscard]] GpsdCounts counts() const noexcept;

 private:
  using Path = std::array<char, 128>;  // of a device, cut, ended by 0

  void look_at_connection(Time now) noexcept;
  void say(std::string_view text) noexcept;
  void write_on(Time now) noexcept;
  void read_on(Time now) noexcept;
  [[nodiscard]] bool refill(Time now) noexcept;
  void take_byte(char byte, Time now) noexcept;
  void hear(std::string_view line, Time now) noexcept;
  void take(const gpsd::Tpv& tpv, Time now) noexcept;
  void give(const gpsd::Tpv& tpv) noexcept;
  void keep_time(Time now) noexcept;
  [[nodiscard]] bool is_ours(std::string_view device, Time now) noexcept;

  ByteStream& stream_;
  GpsdOptions options_;
  FixStamp stamp_;
  FixOutlet outlet_;
  std::uint64_t connection_ = 0;

  std::array<std::uint8_t, 512> chunk_{};
  std::size_t chunk_size_ = 0;
  std::size_t chunk_at_ = 0;
  std::size_t left_ = 0;  // bytes that this poll may still read
  Time arrived_{};        // the chunk
  std::array<char, kLongestLine> line_{};
  std::size_t line_size_ = 0;
  bool line_is_cut_ = false;
  Time begun_{};  // the first byte of the line

  std::string_view saying_;  // what is left to be written, of a constant
  Time heard_{};             // the last byte, or the connection
  Time asked_{};             // for its devices; 0: not since it spoke
  Time tpv_heard_{};         // of our receiver, with a fix or without; or the connection
  DeviceFault receiver_ = DeviceFault::kNone;  // as gpsd last told
  Path path_{};                                // of the receiver that is listened to
  std::optional<double> hdop_;
  Time hdop_heard_{};

  GpsdCounts counts_;
};

}  // namespace lodesman
