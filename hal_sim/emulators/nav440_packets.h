// SPDX-License-Identifier: Apache-2.0
// The payloads of what a NAV440 says, from values in the units of its manual: degrees, g, gauss.
// Pure functions; any thread.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "hal_sim/emulators/uu_frame.h"

namespace lodesman::emulated {

// Body axes: x ahead, y to starboard, z down.
struct Nav440Values {
  double roll_deg = 0.0;                              // starboard down positive
  double pitch_deg = 0.0;                             // bow up positive
  double yaw_deg = 0.0;                               // to starboard positive
  std::array<double, 3> rate_deg_s{};                 // [-630, 630)
  std::array<double, 3> acceleration_g{};             // [-10, 10); level and at rest 0, 0, -1
  std::array<double, 3> field_gauss{};                // [-1, 1)
  std::array<double, 3> velocity_m_s{};               // north, east, down; [-256, 256)
  double longitude_deg = 0.0;                         // [-180, 180)
  double latitude_deg = 0.0;                          // [-90, 90]
  double altitude_m = 0.0;                            // [-100, 16284)
  std::array<double, 3> rate_sensor_temperature_c{};  // [-100, 100)
  double board_temperature_c = 0.0;                   // [-100, 100)
  std::uint32_t itow_ms = 0;
  std::uint16_t counter = 0;
  std::uint16_t bit_status = 0;
};

// The words of the built-in test, in the order of packet T0.
struct Nav440BuiltInTest {
  std::uint16_t bit_status = 0;
  std::uint16_t hardware_bit = 0;
  std::uint16_t hardware_power_bit = 0;
  std::uint16_t hardware_environmental_bit = 0;
  std::uint16_t com_bit = 0;
  std::uint16_t com_serial_a = 0;
  std::uint16_t com_serial_b = 0;
  std::uint16_t software_bit = 0;
  std::uint16_t software_algorithm_bit = 0;
  std::uint16_t software_data_bit = 0;
  std::uint16_t hardware_status = 0;
  std::uint16_t com_status = 0;
  std::uint16_t software_status = 0;
  std::uint16_t sensor_status = 0;
};

// S0, S1, A0, A1, A2, N0 or N1; nothing of another type. What is out of range is the nearest that
// is not; angles and the counts of time wrap.
[[nodiscard]] Bytes data_payload(std::uint16_t type, const Nav440Values& values);
[[nodiscard]] Bytes test_payload(const Nav440BuiltInTest& test);
[[nodiscard]] Bytes identity_payload(std::uint32_t serial_number, std::string_view model);

// Numbers as the unit sends and takes them: the high byte first.
void put_u16(Bytes& bytes, std::uint16_t value);
[[nodiscard]] std::uint16_t u16_at(const Bytes& bytes, std::size_t at);

}  // namespace lodesman::emulated
