// SPDX-License-Identifier: Apache-2.0
// Plays a directory of .83B and .83P files, as the maker's program writes them: records back to
// back, at the times that they carry. They are read whole at start-up, so that no poll waits for a
// disk. Made at start-up; polled by one thread, whose first poll begins the play.
//
// Pings are given in the order of the files' names, each once, stamped with when it is due; of
// several that are due the newest. Where the times stand still, run backwards or leave a gap of
// more than kLongestGap, the next ping comes a repetition later instead. After the last one there
// is silence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "drivers/delta_t/settings.h"
#include "drivers/hal/devices.h"

namespace lodesman {

class PingPlayer final : public ImagingSonar {
 public:
  static constexpr Duration kLongestGap = std::chrono::seconds{10};
  // Half an hour of images at 10 Hz.
  static constexpr std::uint64_t kMost_bytes = std::uint64_t{1} << 30U;

  // Throws StartupError where there is no such directory, no such file in it, one that does not
  // begin with a record, or more than kMost_bytes.
  PingPlayer(const std::filesystem::path& directory, delta_t::BeamSign beam_sign);

  [[nodiscard]] ReadStatus poll(Time now, SonarPing& out) noexcept override;

  [[nodiscard]] std::size_t pings() const noexcept { return entries_.size(); }
  // [-] bytes of the files that are no record.
  [[nodiscard]] std::uint64_t skipped_bytes() const noexcept { return skipped_bytes_; }
  // [ns] from the first ping to the last.
  [[nodiscard]] Duration length() const noexcept {
    return entries_.empty() ? Duration::zero() : entries_.back().due;
  }

 private:
  struct Entry {
    std::size_t at = 0;    // [-] in bytes_
    std::size_t size = 0;  // [-]
    Duration due{};        // [ns] after the first
  };

  void read(const std::filesystem::path& file);
  void index(const std::filesystem::path& file, std::size_t begin);
  void add(const delta_t::Header& header, std::size_t at, std::size_t size);

  delta_t::BeamSign beam_sign_;
  std::vector<std::uint8_t> bytes_;
  std::vector<Entry> entries_;
  std::uint64_t skipped_bytes_ = 0;
  std::optional<Duration> written_;  // of the last record that was added

  bool is_playing_ = false;
  Time begun_{};
  std::size_t next_ = 0;  // entry
  std::uint64_t given_ = 0;
};

}  // namespace lodesman
