// SPDX-License-Identifier: Apache-2.0
#include "tests/system/recorded_track.h"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include "drivers/nmea/framing.h"
#include "drivers/nmea/sentences.h"
#include "tests/unit/nmea/sentence_lines.h"

namespace lodesman::testing {
namespace {

constexpr double kKnot_m_s = 1852.0 / 3600.0;

// Those between, of a log whose first epoch may be cut.
[[nodiscard]] std::vector<Epoch> part_of(std::vector<Epoch> all, std::size_t skipped,
                                         std::size_t count) {
  const std::size_t begin = std::min(skipped + 1, all.size());
  const std::size_t end = std::min(begin + count, all.size());
  return {all.begin() + static_cast<std::ptrdiff_t>(begin),
          all.begin() + static_cast<std::ptrdiff_t>(end)};
}

// What a line says, where its checksum holds.
[[nodiscard]] nmea::Sentence said_by(const std::string& line) {
  NmeaFraming framing;
  for (const char letter : line + "\r\n") {
    if (const auto sentence = framing.push(static_cast<std::uint8_t>(letter))) {
      return nmea::decoded(*sentence);
    }
  }
  return nmea::Malformed{};
}

// dddmm.mmmmmm and its hemisphere.
[[nodiscard]] std::string minutes_of(double deg, int width, char positive, char negative) {
  const double whole = std::floor(std::abs(deg));
  return fmt::format("{:0{}}{:09.6f},{}", static_cast<int>(whole), width,
                     (std::abs(deg) - whole) * 60.0, deg < 0.0 ? negative : positive);
}

struct CatabotRow {
  std::string time;
  GeoPoint place;
  double speed_m_s = 0.0;
  double heading_deg = 0.0;
};

[[nodiscard]] std::optional<CatabotRow> row_of(const std::string& line) {
  std::vector<std::string> fields;
  std::stringstream stream{line};
  for (std::string field; std::getline(stream, field, ',');) {
    fields.push_back(field);
  }
  if (fields.size() < 17 || fields[1].find(':') == std::string::npos) {
    return std::nullopt;
  }
  return CatabotRow{fields[1],
                    {1e-7 * std::stod(fields[15]), 1e-7 * std::stod(fields[16])},
                    std::stod(fields[8]),
                    std::stod(fields[9])};
}

[[nodiscard]] double second_of(const std::string& time) {
  const std::size_t first = time.find(':');
  const std::size_t second = time.find(':', first + 1);
  return 3600.0 * std::stod(time.substr(0, first)) + 60.0 * std::stod(time.substr(first + 1)) +
         std::stod(time.substr(second + 1));
}

[[nodiscard]] std::string sentences_of(const CatabotRow& row, double second_s) {
  const std::string where = minutes_of(row.place.latitude_deg, 2, 'N', 'S') + "," +
                            minutes_of(row.place.longitude_deg, 3, 'E', 'W');
  const std::string clock = clock_of(second_s);
  return line_of(fmt::format("$GPGGA,{},{},1,08,1.0,80.0,M,-30.0,M,,", clock, where)) +
         line_of(fmt::format("$GPRMC,{},A,{},{:.3f},{:.1f},061020,,,A", clock, where,
                             row.speed_m_s / kKnot_m_s, row.heading_deg));
}

}  // namespace

std::vector<Epoch> nmea_epochs(const std::filesystem::path& log, std::size_t skipped,
                               std::size_t count) {
  std::ifstream in{log, std::ios::binary};
  std::vector<Epoch> all;
  std::string line;
  while (std::getline(in, line) && all.size() < skipped + count + 2) {
    while (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    const nmea::Sentence said = said_by(line);
    if (const auto* gga = std::get_if<nmea::Gga>(&said);
        gga != nullptr && gga->time_of_day && gga->place && gga->quality > 0) {
      all.push_back({to_seconds(*gga->time_of_day),
                     {gga->place->latitude_deg, gga->place->longitude_deg},
                     ""});
    }
    if (!all.empty() && !std::holds_alternative<nmea::Malformed>(said)) {
      all.back().sentences += line + "\r\n";
    }
  }
  return part_of(std::move(all), skipped, count);
}

std::vector<Epoch> catabot_epochs(const std::filesystem::path& csv, std::size_t skipped,
                                  std::size_t count) {
  std::ifstream in{csv};
  std::vector<Epoch> all;
  std::string line;
  std::string last;
  while (std::getline(in, line) && all.size() < skipped + count + 2) {
    const std::optional<CatabotRow> row = row_of(line);
    if (!row || row->time == last) {
      continue;
    }
    last = row->time;
    const double second_s = second_of(row->time);
    all.push_back({second_s, row->place, sentences_of(*row, second_s)});
  }
  return part_of(std::move(all), skipped, count);
}

}  // namespace lodesman::testing
