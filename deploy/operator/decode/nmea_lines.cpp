// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/nmea_lines.h"

#include <string>

#include "drivers/nmea/framing.h"
#include "drivers/nmea/sentences.h"

namespace lodesman {
namespace nmea {
namespace {

using Json = nlohmann::ordered_json;

// Fills in what is a sentence's own behind `type`, `known` and `talker`.
class Writer {
 public:
  Writer(Json& json, std::string_view text) : json_{json}, text_{text} {}

  void operator()(const Unknown& /*sentence*/) { json_["text"] = text_; }
  void operator()(const Malformed& /*sentence*/) { json_["text"] = text_; }
  void operator()(const Rmc& sentence) {
    time(sentence.time_of_day);
    json_["valid"] = sentence.valid;
    place(sentence.place);
    put("speed_m_s", sentence.speed_m_s);
    put("course_rad", sentence.course_rad);
    if (sentence.date_ns) {
      json_["date_s"] =
          std::chrono::floor<std::chrono::seconds>(Duration{*sentence.date_ns}).count();
    }
    put("variation_rad", sentence.variation_rad);
    if (sentence.mode != '\0') {
      json_["mode"] = std::string{sentence.mode};
    }
  }
  void operator()(const Gga& sentence) {
    time(sentence.time_of_day);
    place(sentence.place);
    json_["quality"] = sentence.quality;
    put("satellites", sentence.satellites);
    put("hdop", sentence.hdop);
    put("altitude_m", sentence.altitude_m);
    put("geoid_m", sentence.geoid_m);
  }
  void operator()(const Vtg& sentence) {
    put("course_rad", sentence.course_rad);
    put("course_magnetic_rad", sentence.course_magnetic_rad);
    put("speed_m_s", sentence.speed_m_s);
  }
  void operator()(const Hdt& sentence) { put("heading_rad", sentence.heading_rad); }
  void operator()(const Hdg& sentence) {
    put("heading_magnetic_rad", sentence.heading_magnetic_rad);
    put("deviation_rad", sentence.deviation_rad);
    put("variation_rad", sentence.variation_rad);
  }

 private:
  template <class T>
  void put(const char* name, const std::optional<T>& value) {
    if (value) {
      json_[name] = *value;
    }
  }
  void time(const std::optional<Duration>& time_of_day) {
    if (time_of_day) {
      json_["time_of_day_s"] = to_seconds(*time_of_day);
    }
  }
  void place(const std::optional<Place>& place) {
    if (place) {
      json_["latitude_deg"] = place->latitude_deg;
      json_["longitude_deg"] = place->longitude_deg;
    }
  }

  Json& json_;
  std::string_view text_;
};

[[nodiscard]] Json json_of(std::string_view text) {
  const Sentence sentence = decoded(text);
  const bool known =
      !std::holds_alternative<Unknown>(sentence) && !std::holds_alternative<Malformed>(sentence);
  Json json{{"type", type_of(text)}, {"known", known}};
  if (const std::string_view talker = talker_of(text); !talker.empty()) {
    json["talker"] = talker;
  }
  std::visit(Writer{json, text}, sentence);
  return json;
}

}  // namespace
}  // namespace nmea

DecodeCounts nmea_lines(std::span<const std::uint8_t> bytes,
                        const std::function<void(const nlohmann::ordered_json&)>& line) {
  NmeaFraming framing;
  for (const std::uint8_t byte : bytes) {
    if (const auto sentence = framing.push(byte)) {
      line(nmea::json_of(*sentence));
    }
  }
  const NmeaFramingCounts& counts = framing.counts();
  return {counts.sentences, counts.skipped_bytes + framing.pending(),
          counts.wrong_checksums + counts.without_checksum + counts.broken + counts.too_long};
}

}  // namespace lodesman
