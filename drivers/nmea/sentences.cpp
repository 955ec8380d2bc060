// SPDX-License-Identifier: Apache-2.0
#include "drivers/nmea/sentences.h"

#include "drivers/nmea/fields.h"

namespace lodesman::nmea {
namespace {

constexpr std::size_t kTalkerSize = 2;
constexpr std::size_t kTypeSize = 3;

// "GPRMC" of "$GPRMC,123500.00,A".
[[nodiscard]] std::string_view address_of(std::string_view sentence) noexcept {
  const std::string_view behind = sentence.empty() ? sentence : sentence.substr(1);
  return behind.substr(0, behind.find(','));
}

[[nodiscard]] bool has_talker(std::string_view sentence) noexcept {
  const std::string_view address = address_of(sentence);
  return !sentence.empty() && sentence[0] == '$' && address.size() == kTalkerSize + kTypeSize &&
         address[0] != 'P';
}

[[nodiscard]] Sentence rmc_of(Fields& fields) noexcept {
  Rmc rmc;
  rmc.time_of_day = fields.time_of_day();
  const char status = fields.letter("AV");
  rmc.valid = status == 'A';
  rmc.place = fields.place();
  rmc.speed_m_s = fields.knots();
  rmc.course_rad = fields.course_rad();
  rmc.date_ns = fields.date_ns();
  rmc.variation_rad = fields.east_rad();
  rmc.mode = fields.letter("ADEFMNPRS");
  return fields.sound() ? Sentence{rmc} : Malformed{};
}

[[nodiscard]] Sentence gga_of(Fields& fields) noexcept {
  Gga gga;
  gga.time_of_day = fields.time_of_day();
  gga.place = fields.place();
  gga.quality = fields.count(8).value_or(0);
  gga.satellites = fields.count(199);
  gga.hdop = fields.number(0.0, 100.0);
  gga.altitude_m = fields.number(-1e5, 1e5);
  static_cast<void>(fields.letter("M"));
  gga.geoid_m = fields.number(-1e4, 1e4);
  return fields.sound() ? Sentence{gga} : Malformed{};
}

// Since NMEA 2.0 each number has its unit behind it; before, there were four bare numbers.
[[nodiscard]] Sentence vtg_of(Fields& fields) noexcept {
  Vtg vtg;
  vtg.course_rad = fields.course_rad();
  static_cast<void>(fields.letter("T"));
  vtg.course_magnetic_rad = fields.course_rad();
  static_cast<void>(fields.letter("M"));
  vtg.speed_m_s = fields.knots();
  static_cast<void>(fields.letter("N"));
  const std::optional<double> km_h = fields.number(0.0, 3600.0);
  if (!vtg.speed_m_s && km_h) {
    vtg.speed_m_s = *km_h / 3.6;
  }
  return fields.sound() ? Sentence{vtg} : Malformed{};
}

[[nodiscard]] Sentence hdt_of(Fields& fields) noexcept {
  const Hdt hdt{fields.course_rad()};
  return fields.sound() ? Sentence{hdt} : Malformed{};
}

[[nodiscard]] Sentence hdg_of(Fields& fields) noexcept {
  Hdg hdg;
  hdg.heading_magnetic_rad = fields.course_rad();
  hdg.deviation_rad = fields.east_rad();
  hdg.variation_rad = fields.east_rad();
  return fields.sound() ? Sentence{hdg} : Malformed{};
}

}  // namespace

std::string_view type_of(std::string_view sentence) noexcept {
  return address_of(sentence).substr(has_talker(sentence) ? kTalkerSize : 0);
}

std::string_view talker_of(std::string_view sentence) noexcept {
  return has_talker(sentence) ? address_of(sentence).substr(0, kTalkerSize) : std::string_view{};
}

Sentence decoded(std::string_view sentence) noexcept {
  if (!has_talker(sentence)) {
    return Unknown{};
  }
  const std::string_view type = type_of(sentence);
  Fields fields{sentence};
  return type == "RMC"   ? rmc_of(fields)
         : type == "GGA" ? gga_of(fields)
         : type == "VTG" ? vtg_of(fields)
         : type == "HDT" ? hdt_of(fields)
         : type == "HDG" ? hdg_of(fields)
                         : Sentence{Unknown{}};
}

}  // namespace lodesman::nmea
