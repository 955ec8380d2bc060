// SPDX-License-Identifier: Apache-2.0
// Joins the sentences that tell of one fix: RMC and GGA of one time of day, in either order, and a
// VTG where RMC says nothing of speed. An epoch is whole when both have come; where a receiver has
// sent one kind alone for kLone epochs that one is enough, and until that is known it is waited for
// kHold at the most. Owned by one driver, on its thread; nothing allocates.
#pragma once

#include <optional>

#include "drivers/nmea/sentences.h"

namespace lodesman::nmea {

struct Epoch {
  Duration time_of_day{};
  Time arrived{};  // of its first sentence's first byte
  std::optional<Rmc> rmc;
  std::optional<Gga> gga;
  std::optional<Vtg> vtg;  // of this epoch or the one before
};

class Epochs {
 public:
  static constexpr Duration kHold = std::chrono::milliseconds{300};
  static constexpr int kLone = 3;
  // An older VTG is of another fix.
  static constexpr Duration kVtgLasts = std::chrono::milliseconds{1500};

  void restart() noexcept;
  // arrived: of the sentence's first byte. A sentence without a time belongs to no epoch: false.
  bool take(const Rmc& rmc, Time arrived) noexcept;
  bool take(const Gga& gga, Time arrived) noexcept;
  void take(const Vtg& vtg, Time arrived) noexcept;

  // The next epoch that is whole or waited for long enough, each once. To be asked after each
  // sentence, and once a poll.
  [[nodiscard]] std::optional<Epoch> next(Time now) noexcept;

 private:
  // The one of this time, begun anew where there is none.
  [[nodiscard]] Epoch& epoch_of(Duration time_of_day, Time arrived) noexcept;
  [[nodiscard]] Epoch with_vtg(Epoch epoch) const noexcept;

  std::optional<Epoch> open_;
  std::optional<Epoch> closed_;  // that was not given when the next one began
  bool is_given_ = false;        // the open one
  int lone_ = 0;                 // epochs in a row of one kind of sentence
  std::optional<Vtg> vtg_;
  Time vtg_arrived_{};
};

}  // namespace lodesman::nmea
