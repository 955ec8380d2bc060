// SPDX-License-Identifier: Apache-2.0
// A Crossbow NAV440 to the byte: it streams its packet by itself and obeys the manual's commands.
// What it feels is told to it; its clock runs as fast as it is made to. One thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "hal_sim/emulators/faulty_device.h"
#include "hal_sim/emulators/nav440_packets.h"
#include "hal_sim/emulators/nav440_settings.h"
#include "hal_sim/emulators/uu_frame.h"
#include "mid_level/base/random_stream.h"

namespace lodesman {

// What the unit is carried through.
struct EmulatedMotion {
  double heading_true_rad = 0.0;  // clockwise from north
  double yaw_rate_rad_s = 0.0;    // clockwise positive
  double north_m_s = 0.0;         // over ground
  double east_m_s = 0.0;
  double latitude_deg = 0.0;
  double longitude_deg = 0.0;
  double roll_rad = 0.0;   // starboard down positive
  double pitch_rad = 0.0;  // bow up positive
  // When it was so: heading and place go on from there at these rates. 0: it is so whenever asked.
  Time measured{};
};

struct Nav440UnitOptions {
  std::uint32_t serial_number = 440123456;
  // Its first word says what kind it is: AHRS440 streams A1, VG440 A2, any other N1.
  std::string model = "NAV440 2.0.1 8350-2000";
  std::array<std::uint8_t, 5> version{2, 0, 1, 0, 0};  // major, minor, patch, stage, build
  // Stored, as its owner left it; a packet type of 0 is what suits its kind.
  std::uint16_t divider = 2;
  std::uint16_t baud_code = 2;
  std::uint16_t packet_type = 0;
  bool newer_firmware = true;  // refuses what does not fit its line
  double clock_drift_ppm = 0.0;
  std::uint32_t itow_offset_ms = 0;  // what its clock shows when it is switched on
  bool constant_itow = false;        // it has no such clock, as some of its sisters
  double declination_deg = 0.0;      // east positive: true heading less this is magnetic
  Duration initialising = std::chrono::seconds{20};
  bool flicker = true;  // the last bit of what it measures is never still
  std::uint64_t seed = 0;
  double altitude_m = 0.0;
  double temperature_c = 25.0;
  double field_horizontal_gauss = 0.25;
  double field_down_gauss = 0.35;
};

class Nav440Unit final : public FaultyDevice {
 public:
  // Switched on `on_for` before `now`.
  Nav440Unit(const Nav440UnitOptions& options, Time now, Duration on_for = Duration::zero());

  void set_motion(const EmulatedMotion& motion) noexcept { motion_ = motion; }

  void step(Time now, std::vector<Utterance>& said) override;
  void receive(std::span<const std::uint8_t> bytes, Time at, std::vector<Utterance>& said) override;
  void power_cycle(Time now) override;
  [[nodiscard]] int baud() const override { return live_.baud(); }

  [[nodiscard]] bool has_fault(FaultKind kind) const noexcept override;
  void set_thrust_share(double share) noexcept override { thrust_share_ = share; }

 private:
  // Whether a turn for the magnetic calibration is being made, and who ends it.
  enum class Calibration : std::uint8_t { kNone, kUntilStopped, kUntilTurned };

  void obey(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void give_packet(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void set_fields(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void give_fields(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void calibrate(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void echo(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void refuse(const emulated::UuCommand& command, std::vector<Utterance>& said);
  void say(std::uint16_t type, const emulated::Bytes& payload, Time at,
           std::vector<Utterance>& said);

  void tick(Time at, std::vector<Utterance>& said);
  void tick_until(Time until, std::vector<Utterance>& said);
  void turn_on(Time at) noexcept;
  void reset_at_begin_of(Time now, std::vector<Utterance>& said);
  void watch_turn(Time at, std::vector<Utterance>& said);

  [[nodiscard]] bool offers(std::uint16_t type) const noexcept;
  [[nodiscard]] bool takes(const emulated::Nav440Settings& settings, std::uint16_t id,
                           std::uint16_t value) const;
  [[nodiscard]] Time time_of_tick(std::int64_t tick) const noexcept;
  [[nodiscard]] std::uint32_t itow_ms(Time at) const noexcept;
  [[nodiscard]] double unit_time_s(Time at) const noexcept;
  [[nodiscard]] double heading_true_rad(Time at) const noexcept;
  [[nodiscard]] emulated::Nav440BuiltInTest built_in_test(Time at) const noexcept;
  [[nodiscard]] emulated::Nav440Values measure(Time at);
  [[nodiscard]] emulated::Nav440Values values_for(std::uint16_t type, Time at);
  [[nodiscard]] double yaw_error_deg(Time at);

  Nav440UnitOptions options_;
  emulated::Nav440Settings stored_;
  emulated::Nav440Settings live_;
  emulated::UuReceiver receiver_;
  EmulatedMotion motion_;
  double thrust_share_ = 0.0;
  RandomStream flicker_;
  RandomStream spikes_;

  Time power_on_{};
  Time settling_since_{};       // switched on, or its algorithm was reset
  std::int64_t next_tick_ = 0;  // of its 100 Hz
  std::optional<Time> resets_at_;
  double yaw_at_power_on_rad_ = 0.0;
  Time sent_until_{};  // by when its line has taken what was said
  std::optional<Time> overflowed_;
  std::uint16_t counter_ = 0;
  std::optional<emulated::Nav440Values> frozen_;
  Calibration calibration_ = Calibration::kNone;
  double turned_rad_ = 0.0;
  double turned_heading_rad_ = 0.0;
};

}  // namespace lodesman
