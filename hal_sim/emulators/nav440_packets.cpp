// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/emulators/nav440_packets.h"

#include <algorithm>
#include <cmath>

namespace lodesman::emulated {
namespace {

// What all the counts of a number together come to.
constexpr double kAngleSpan_deg = 360.0;
constexpr double kRateSpan_deg_s = 1260.0;
constexpr double kAccelerationSpan_g = 20.0;
constexpr double kFieldSpan_gauss = 2.0;
constexpr double kTemperatureSpan_c = 200.0;
constexpr double kVelocitySpan_m_s = 512.0;
constexpr double kAltitudeSpan_m = 16384.0;

constexpr double kCounts16 = 65536.0;
constexpr double kCounts32 = 4294967296.0;

void put_u32(Bytes& bytes, std::uint32_t value) {
  put_u16(bytes, static_cast<std::uint16_t>(value >> 16U));
  put_u16(bytes, static_cast<std::uint16_t>(value & 0xFFFFU));
}

// The nearest count, and the last one where there is none.
void put_held(Bytes& bytes, double value, double span) {
  const double count = std::clamp(std::round(value * (kCounts16 / span)), -32768.0, 32767.0);
  put_u16(bytes, static_cast<std::uint16_t>(static_cast<std::int32_t>(count)));
}

// The nearest count of a number that has no end.
void put_wrapped(Bytes& bytes, double value, double span) {
  const auto count = static_cast<std::int64_t>(std::round(value * (kCounts16 / span)));
  put_u16(bytes, static_cast<std::uint16_t>(count & 0xFFFF));
}

void put_degrees32(Bytes& bytes, double deg) {
  const auto count = static_cast<std::int64_t>(std::round(deg * (kCounts32 / kAngleSpan_deg)));
  put_u32(bytes, static_cast<std::uint32_t>(count & 0xFFFFFFFF));
}

void put_three(Bytes& bytes, const std::array<double, 3>& values, double span) {
  for (const double value : values) {
    put_held(bytes, value, span);
  }
}

void put_angles(Bytes& bytes, const Nav440Values& v) {
  put_wrapped(bytes, v.roll_deg, kAngleSpan_deg);
  put_wrapped(bytes, v.pitch_deg, kAngleSpan_deg);
  put_wrapped(bytes, v.yaw_deg, kAngleSpan_deg);
}
void put_rates(Bytes& bytes, const Nav440Values& v) {
  put_three(bytes, v.rate_deg_s, kRateSpan_deg_s);
}
void put_accelerations(Bytes& bytes, const Nav440Values& v) {
  put_three(bytes, v.acceleration_g, kAccelerationSpan_g);
}
void put_field(Bytes& bytes, const Nav440Values& v) {
  put_three(bytes, v.field_gauss, kFieldSpan_gauss);
}
void put_velocity(Bytes& bytes, const Nav440Values& v) {
  put_three(bytes, v.velocity_m_s, kVelocitySpan_m_s);
}
void put_rate_temperatures(Bytes& bytes, const Nav440Values& v) {
  put_three(bytes, v.rate_sensor_temperature_c, kTemperatureSpan_c);
}
void put_temperature(Bytes& bytes, double c) { put_held(bytes, c, kTemperatureSpan_c); }
// Longitude first.
void put_place(Bytes& bytes, const Nav440Values& v) {
  put_degrees32(bytes, v.longitude_deg);
  put_degrees32(bytes, v.latitude_deg);
  put_wrapped(bytes, v.altitude_m, kAltitudeSpan_m);
}
void put_itow16(Bytes& bytes, const Nav440Values& v) {
  put_u16(bytes, static_cast<std::uint16_t>(v.itow_ms & 0xFFFFU));
}

void put_sensors(Bytes& bytes, const Nav440Values& v, bool with_field) {
  put_accelerations(bytes, v);
  put_rates(bytes, v);
  if (with_field) {
    put_field(bytes, v);
  }
  put_rate_temperatures(bytes, v);
  put_temperature(bytes, v.board_temperature_c);
  if (with_field) {
    put_itow16(bytes, v);
  } else {
    put_u16(bytes, v.counter);
  }
}

void put_attitude(Bytes& bytes, const Nav440Values& v, std::uint16_t type) {
  put_angles(bytes, v);
  put_rates(bytes, v);
  put_accelerations(bytes, v);
  if (type == uu_type('A', '2')) {
    put_rate_temperatures(bytes, v);
  } else {
    put_field(bytes, v);
  }
  if (type == uu_type('A', '0')) {
    put_temperature(bytes, v.board_temperature_c);
    put_itow16(bytes, v);
  } else {
    if (type == uu_type('A', '1')) {
      put_temperature(bytes, v.rate_sensor_temperature_c[0]);
    }
    put_u32(bytes, v.itow_ms);
  }
}

void put_navigation(Bytes& bytes, const Nav440Values& v, bool whole) {
  put_angles(bytes, v);
  put_rates(bytes, v);
  if (whole) {
    put_accelerations(bytes, v);
  }
  put_velocity(bytes, v);
  put_place(bytes, v);
  if (whole) {
    put_temperature(bytes, v.rate_sensor_temperature_c[0]);
    put_u32(bytes, v.itow_ms);
  } else {
    put_itow16(bytes, v);
  }
}

}  // namespace

void put_u16(Bytes& bytes, std::uint16_t value) {
  bytes.push_back(static_cast<std::uint8_t>(value >> 8U));
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFFU));
}

std::uint16_t u16_at(const Bytes& bytes, std::size_t at) {
  return static_cast<std::uint16_t>((bytes[at] << 8) | bytes[at + 1]);
}

Bytes data_payload(std::uint16_t type, const Nav440Values& values) {
  Bytes bytes;
  switch (type) {
    case uu_type('S', '0'): put_sensors(bytes, values, true); break;
    case uu_type('S', '1'): put_sensors(bytes, values, false); break;
    case uu_type('A', '0'):
    case uu_type('A', '1'):
    case uu_type('A', '2'): put_attitude(bytes, values, type); break;
    case uu_type('N', '0'): put_navigation(bytes, values, false); break;
    case uu_type('N', '1'): put_navigation(bytes, values, true); break;
    default: return bytes;
  }
  put_u16(bytes, values.bit_status);
  return bytes;
}

Bytes test_payload(const Nav440BuiltInTest& test) {
  Bytes bytes;
  for (const std::uint16_t word :
       {test.bit_status, test.hardware_bit, test.hardware_power_bit,
        test.hardware_environmental_bit, test.com_bit, test.com_serial_a, test.com_serial_b,
        test.software_bit, test.software_algorithm_bit, test.software_data_bit,
        test.hardware_status, test.com_status, test.software_status, test.sensor_status}) {
    put_u16(bytes, word);
  }
  return bytes;
}

Bytes identity_payload(std::uint32_t serial_number, std::string_view model) {
  Bytes bytes;
  put_u32(bytes, serial_number);
  bytes.insert(bytes.end(), model.begin(), model.end());
  bytes.push_back(0);
  return bytes;
}

}  // namespace lodesman::emulated
