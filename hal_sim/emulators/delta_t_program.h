// SPDX-License-Identifier: Apache-2.0
// The maker's program beside an Imagenex Delta T head, as the boat meets it: it pings by itself,
// sends a record a ping and obeys the datagrams that set it, from the next ping on. What the head
// hears is told to it. Each utterance is one datagram. One thread.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "hal_sim/emulators/delta_t_control.h"
#include "hal_sim/emulators/delta_t_record.h"
#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/sonar/ping_fault.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

struct DeltaTProgramOptions {
  emulated::DeltaTSettings settings;                 // as its user left them
  Duration period = std::chrono::milliseconds{100};  // of its pings; the sound may take longer
  std::uint16_t samples = 500;                       // a beam of an image
  std::uint16_t frequency_khz = 260;
  // A program of 2010 sends images of 120 beams over 120 degrees alone: it works so, whatever else
  // it is told. False: of any geometry that fits a datagram.
  bool images_are_120_by_120 = true;
  bool fine_ranges = true;         // of profiles: 5000 a range, else as many as samples
  bool has_intensity = true;       // of profiles
  bool whole_image_header = true;  // what of it is not documented is as in a profile's; else 0
  emulated::ExternalAttitude external = emulated::ExternalAttitude::kNone;
  // From the ping until its record leaves, beside the sound's way, and the part of it that passes
  // before the ping by the program's own count.
  Duration processing = std::chrono::milliseconds{10};
  Duration ping_latency = std::chrono::microseconds{500};
  Duration leaves_at_multiples_of{};  // after the ping; 0: at once
  bool instant = false;               // there is no latency at all
  double water_sound_speed_m_s = 1500.0;
  Duration epoch = emulated::kVirtualEpoch;  // of its clock: since 1970, at Time 0
  std::uint64_t seed = 0;
};

// What else is so at the moment of a ping.
struct PingSituation {
  double heading_true_rad = 0.0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double speed_m_s = 0.0;  // over ground
  double course_rad = 0.0;
  double thrust_load = 0.0;  // as in the world's sample
};

class DeltaTProgram final : public FaultyDevice {
 public:
  DeltaTProgram(const DeltaTProgramOptions& options, Time now);

  // Whether it is time for a ping. Its rays are the beams' centres, which are then to be listened
  // along: clockwise from straight ahead.
  [[nodiscard]] bool is_due(Time now) const noexcept;
  [[nodiscard]] std::size_t beams() const noexcept;
  [[nodiscard]] double bearing_rad(std::size_t beam) const noexcept;
  // Pings: `surfaces_m` has the nearest surface of each beam, infinity where there is none.
  void ping(std::span<const double> surfaces_m, const PingSituation& situation, Time now);

  // As the next ping has them.
  [[nodiscard]] const emulated::DeltaTSettings& settings() const noexcept { return settings_; }
  [[nodiscard]] std::uint32_t newest_ping() const noexcept { return number_; }
  [[nodiscard]] Duration latency() const noexcept;

  void step(Time now, std::vector<Utterance>& said) override;
  // One datagram.
  void receive(std::span<const std::uint8_t> bytes, Time at, std::vector<Utterance>& said) override;
  void power_cycle(Time now) override;
  [[nodiscard]] int baud() const override { return 0; }

  [[nodiscard]] bool has_fault(FaultKind kind) const noexcept override;

 private:
  struct Heard {
    std::vector<double> surfaces_m;
    std::vector<std::uint8_t> image;
  };

  void begun(const Fault& fault, Time now) override;
  [[nodiscard]] bool makes_images() const noexcept;
  [[nodiscard]] double increment_deg() const noexcept;
  [[nodiscard]] std::uint16_t resolution_mm(bool fine) const noexcept;
  [[nodiscard]] double brightness() const noexcept;
  [[nodiscard]] std::size_t averaged() const noexcept;
  [[nodiscard]] Duration period() const noexcept;
  [[nodiscard]] emulated::DeltaTHeader header(const PingSituation& situation, Time now) const;
  [[nodiscard]] Heard hear(std::span<const double> surfaces_m, double thrust_load);
  void draw(double thrust_load, Heard& heard);
  // The one that alters what is heard, or one of the kind kNone.
  [[nodiscard]] Fault ping_fault() const noexcept;
  void remember(Heard heard);
  [[nodiscard]] std::vector<std::uint8_t> mean_image() const;
  [[nodiscard]] double mean_surface_m(std::size_t beam) const noexcept;
  [[nodiscard]] std::vector<std::uint8_t> record(const emulated::DeltaTHeader& header) const;
  void count(Time now);
  void spoil(std::vector<std::uint8_t>& record, Time now);
  void say_foreign(Time now, std::vector<Utterance>& said);

  DeltaTProgramOptions options_;
  emulated::DeltaTSettings settings_;
  RandomStream repeats_;
  RandomStream spoils_;
  RandomStream foreign_;
  PingFault ping_fault_;
  std::uint32_t number_ = 0;
  bool any_ping_ = false;
  Time next_ping_{};
  Time foreign_until_{};
  double foreign_left_ = -1.0;
  std::deque<Heard> heard_;  // the last ones, as many as it averages
  std::vector<Utterance> waiting_;
};

}  // namespace lodesman
