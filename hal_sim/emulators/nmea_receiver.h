// SPDX-License-Identifier: Apache-2.0
// A satellite receiver that speaks NMEA 0183: at each epoch of UTC GGA, RMC, VTG and, where its
// antennas tell it, HDT. Where it is is told to it; what it says of that has its error, and its own
// faults. It takes no commands. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/emulators/nmea_sentence.h"
#include "mid_level/base/geodesy.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

// Where the antenna is, by the truth.
struct AntennaMotion {
  double x_m = 0.0;  // [world] east
  double y_m = 0.0;  // [world] north
  double east_m_s = 0.0;
  double north_m_s = 0.0;
  double heading_true_rad = 0.0;
  Time measured{};  // it goes on from there at this speed
};

struct NmeaReceiverOptions {
  GeoPoint origin;       // of the world
  double sigma_m = 1.0;  // of an ordinary fix, east and north each
  double rtk_float_sigma_m = 0.3;
  double rtk_fixed_sigma_m = 0.02;
  // Ours: 5 fixes a second, as small receivers are set, at the speed that they fit into.
  Duration period = std::chrono::milliseconds{200};
  int baud = 38400;
  Duration latency = std::chrono::milliseconds{40};  // from the fix to the first byte
  std::string talker = "GP";
  int minute_decimals = 5;  // 0.00001 minute: 2 cm of latitude
  bool says_heading = false;
  std::optional<double> variation_deg;
  double altitude_m = 0.0;
  double geoid_m = 0.0;
  Duration epoch = emulated::kVirtualEpoch;  // UTC: since 1970, at Time 0
  std::uint64_t seed = 0;
};

// Apart from the driver of the same name.
class EmulatedNmeaReceiver final : public FaultyDevice {
 public:
  // Switched on so long ago that it has its fix.
  EmulatedNmeaReceiver(const NmeaReceiverOptions& options, Time now);

  // Nothing is said before this was told.
  void set_motion(const AntennaMotion& motion) noexcept { motion_ = motion; }

  void step(Time now, std::vector<Utterance>& said) override;
  void receive(std::span<const std::uint8_t> bytes, Time at, std::vector<Utterance>& said) override;
  void power_cycle(Time now) override;
  [[nodiscard]] int baud() const override { return options_.baud; }

  [[nodiscard]] bool has_fault(FaultKind kind) const noexcept override;

  // From power-up to the first fix (ours: with the almanac of a moment ago).
  static constexpr Duration kFirstFixAfter = std::chrono::seconds{3};

 private:
  [[nodiscard]] emulated::NmeaFix fix_at(Time at);
  [[nodiscard]] double sigma_m() const noexcept;
  void put_place(Time at, emulated::NmeaFix& fix);
  void change_quality(Time at);
  void say(std::string sentence, Time at, std::vector<Utterance>& said);

  NmeaReceiverOptions options_;
  LocalFrame frame_;
  RandomStream noise_;
  RandomStream spikes_;
  RandomStream qualities_;
  RandomStream sums_;
  std::optional<AntennaMotion> motion_;
  Time next_{};  // epoch
  Time first_fix_{};
  emulated::NmeaQuality quality_ = emulated::NmeaQuality::kOrdinary;
  std::optional<GeoPoint> frozen_;
};

}  // namespace lodesman
