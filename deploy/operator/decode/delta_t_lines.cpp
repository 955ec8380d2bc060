// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/delta_t_lines.h"

#include <algorithm>
#include <string>

#include "drivers/delta_t/scan.h"

namespace lodesman {
namespace delta_t {
namespace {

using Json = nlohmann::ordered_json;

// Texts of a device may hold anything.
template <std::size_t kSize>
[[nodiscard]] std::string printed(const Text<kSize>& text) {
  std::string shown{text_of(text)};
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return shown;
}

[[nodiscard]] Json or_null(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

[[nodiscard]] int greatest(Bytes bytes) {
  return bytes.empty() ? 0 : *std::max_element(bytes.begin(), bytes.end());
}

// Fills in what is its own behind `type` and `known`.
class Writer {
 public:
  explicit Writer(Json& json) : json_{json} {}

  void operator()(const Nothing& /*nothing*/) {}

  void operator()(const Record& record) {
    const Header& h = record.header;
    begin(h.kind == RecordKind::kImage ? "83B" : "83P");
    time_and_place(h);
    geometry(h);
    extended(h);
    if (h.kind == RecordKind::kImage) {
      json_["greatest_echo"] = greatest(record.body);
    } else {
      points(record);
    }
  }

  void operator()(const RawFileRecord& r) {
    begin("837");
    time_and_place(r);
    json_["data_points"] = r.data_points;
    json_["range_m"] = r.range_m;
    json_["gain_db"] = r.gain_db;
    json_["pulse_s"] = r.pulse_s;
    json_["frequency_hz"] = r.frequency_hz;
    json_["sound_speed_m_s"] = r.sound_speed_m_s;
    json_["repetition_s"] = r.repetition_s;
    json_["tilt_rad"] = or_null(r.tilt_rad);
    json_["pings_averaged"] = r.pings_averaged;
    json_["display_mode"] = r.display_mode;
    json_["status"] = r.status;
    json_["packet"] = r.packet;
    json_["greatest_echo"] = greatest(r.echoes);
  }

  void operator()(const SwitchCommand& c) {
    begin("switch_command");
    json_["range_m"] = c.range_m;
    json_["nadir_offset_rad"] = c.nadir_offset_rad;
    json_["gain_db"] = c.gain_db;
    json_["log_f"] = c.log_f;
    json_["absorption_db_m"] = c.absorption_db_m;
    json_["agc_threshold"] = c.agc_threshold;
    json_["packet"] = c.packet;
    json_["pulse_s"] = c.pulse_s;
    json_["trigger"] = c.trigger;
    json_["trigger_delay_s"] = c.trigger_delay_s;
    json_["data_points"] = c.data_points;
    json_["data_bits"] = c.data_bits;
    json_["attitude_command"] = c.attitude_command;
    json_["run_mode"] = c.run_mode;
    json_["switch_delay_s"] = c.switch_delay_s;
    json_["frequency_hz"] = c.frequency_hz;
  }

  void operator()(const HeadReply& r) {
    begin("head_reply");
    json_["data_points"] = r.data_points;
    json_["packet"] = r.packet;
    json_["status"] = r.status;
    json_["switch_error"] = r.switch_error();
    json_["firmware"] = r.firmware;
    json_["range_m"] = r.range_m;
    json_["gain_db"] = r.gain_db;
    json_["trigger_status"] = r.trigger_status;
    json_["attitude_sensor"] = r.attitude_sensor;
    json_["pitch_rad"] = r.pitch_rad;
    json_["roll_rad"] = r.roll_rad;
    json_["heading_rad"] = r.heading_rad;
    json_["timer_ticks"] = r.timer_ticks;
    json_["run_mode"] = r.run_mode;
    json_["agc_bin"] = r.agc_bin;
    json_["agc_most"] = r.agc_most;
    json_["greatest_echo"] = greatest(r.echoes);
  }

  void operator()(const Control& c) {
    begin("control");
    json_["output"] = c.output == RecordKind::kImage ? "83B" : "83P";
    json_["range_m"] = c.range_m;
    json_["gain_db"] = c.gain_db;
    json_["display_gain_percent"] = c.display_gain_percent;
    json_["sector_deg"] = c.sector_deg;
    json_["beams"] = c.beams;
    json_["sound_speed_m_s"] = c.sound_speed_m_s;
    json_["least_level_percent"] = c.least_level_percent;
    json_["least_range_m"] = c.least_range_m;
    json_["transducer_up"] = c.transducer_up;
  }

 private:
  void begin(const char* type) { json_ = {{"type", type}, {"known", true}}; }

  template <class AnyRecord>
  void time_and_place(const AnyRecord& r) {
    json_["date"] = printed(r.date);
    json_["time"] =
        printed(r.time) +
        printed(text_of(r.milliseconds).empty() ? widened(r.hundredths) : r.milliseconds);
    json_["latitude_deg"] = or_null(degrees_in(text_of(r.latitude)));
    json_["longitude_deg"] = or_null(degrees_in(text_of(r.longitude)));
    json_["speed_m_s"] = r.speed_m_s;
    json_["course_rad"] = r.course_rad;
    json_["pitch_rad"] = or_null(r.pitch_rad);
    json_["roll_rad"] = or_null(r.roll_rad);
    json_["heading_rad"] = or_null(r.heading_rad);
  }
  [[nodiscard]] static Text<5> widened(const Text<4>& text) {
    Text<5> wide{};
    std::copy(text.begin(), text.end(), wide.begin());
    return wide;
  }

  void geometry(const Header& h) {
    json_["ping"] = h.ping_number;
    json_["beams"] = h.beams;
    json_["samples"] = h.samples;
    json_["sector_rad"] = h.sector_rad;
    json_["first_bearing_rad"] = h.first_bearing_rad;
    json_["beam_step_rad"] = h.beam_step_rad;
    json_["fills_its_sector"] = h.fills_its_sector();
    json_["range_m"] = h.range_m;
    json_["frequency_hz"] = h.frequency_hz;
    json_["sound_speed_m_s"] = or_null(h.sound_speed);
    json_["resolution_m"] = h.resolution_m;
    json_["resolution_was_cm"] = h.resolution_was_cm;
    json_["pulse_s"] = h.pulse_s;
    json_["tilt_rad"] = h.tilt_rad;
    json_["repetition_s"] = h.repetition_s;
  }

  void extended(const Header& h) {
    json_["offset_m"] = h.offset_m;
    json_["ping_latency_s"] = to_seconds(h.ping_latency);
    json_["data_latency_s"] = to_seconds(h.data_latency);
    json_["sample_rate_code"] = h.sample_rate_code;
    json_["flags"] = h.flags;
    json_["pings_averaged"] = h.pings_averaged;
    json_["centre_ping_offset_s"] = to_seconds(h.centre_ping_offset);
    json_["heave_m"] = or_null(h.heave_m);
    json_["altitude_m"] = or_null(h.altitude_m);
    json_["external_pitch_rad"] = or_null(h.external_pitch_rad);
    json_["external_roll_rad"] = or_null(h.external_roll_rad);
    json_["external_heading_rad"] = or_null(h.external_heading_rad);
    json_["auto_scan"] = h.auto_scan;
    json_["scan_angle_rad"] = or_null(h.scan_angle_rad);
  }

  // By the header's sound speed; 0 without a return.
  void points(const Record& record) {
    json_["ranges_m"] = Json::array();
    for (std::uint32_t beam = 0; beam < record.header.beams; ++beam) {
      json_["ranges_m"].push_back(record.range_m(beam));
    }
    if (record.header.has_intensities) {
      json_["intensities"] = Json::array();
      for (std::uint32_t beam = 0; beam < record.header.beams; ++beam) {
        json_["intensities"].push_back(record.intensity(beam));
      }
    }
  }

  Json& json_;
};

}  // namespace
}  // namespace delta_t

DecodeCounts delta_t_lines(std::span<const std::uint8_t> bytes,
                           const std::function<void(const nlohmann::ordered_json&)>& line) {
  DecodeCounts counts;
  while (!bytes.empty()) {
    const delta_t::Found found = delta_t::look_at_front(bytes);
    if (std::holds_alternative<delta_t::Nothing>(found.what)) {
      counts.skipped_bytes += found.size;
      counts.refused += found.refused ? 1 : 0;
    } else {
      nlohmann::ordered_json json;
      std::visit(delta_t::Writer{json}, found.what);
      ++counts.packets;
      line(json);
    }
    bytes = bytes.subspan(found.size);
  }
  return counts;
}

}  // namespace lodesman
