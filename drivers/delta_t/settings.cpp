// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/settings.h"

#include <charconv>
#include <string>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// One of the numbers that the program knows.
template <std::size_t kSize>
[[nodiscard]] int listed(const DeviceAddress& address, std::string_view setting, int otherwise,
                         const std::array<int, kSize>& numbers) {
  std::array<std::string, kSize> texts;
  std::vector<std::string_view> words;
  for (std::size_t i = 0; i < kSize; ++i) {
    texts[i] = std::to_string(numbers[i]);
    words.emplace_back(texts[i]);
  }
  const std::string word = address.word(setting, std::to_string(otherwise), words);
  int number = 0;
  std::from_chars(word.data(), word.data() + word.size(), number);
  return number;
}

}  // namespace

std::vector<std::string_view> delta_t_settings() {
  return {"port",
          "output",
          "range_m",
          "gain_db",
          "sector_deg",
          "beams",
          "sound_speed_m_s",
          "display_gain_percent",
          "least_level_percent",
          "least_range_m",
          "transducer",
          "control",
          "beam_sign"};
}

DeltaTSettings delta_t_settings_in(const DeviceAddress& address) {
  if (address.place().empty()) {
    throw StartupError("needs the computer on which the maker's program runs: delta_t:HOST");
  }
  DeltaTSettings settings;
  delta_t::Control& control = settings.control;
  settings.port = static_cast<std::uint16_t>(address.integer("port", kDeltaTPort, 1, 65535));
  control.output = address.word("output", "83B", {"83B", "83P"}) == "83B"
                       ? delta_t::RecordKind::kImage
                       : delta_t::RecordKind::kProfile;
  control.range_m = listed(address, "range_m", control.range_m, delta_t::kRanges_m);
  control.gain_db = address.integer("gain_db", control.gain_db, 0, 20);
  control.sector_deg = listed(address, "sector_deg", control.sector_deg, delta_t::kSectors_deg);
  control.beams = listed(address, "beams", control.beams, delta_t::kBeams);
  control.sound_speed_m_s =
      address.number("sound_speed_m_s", control.sound_speed_m_s, 1400.0, 1600.0);
  control.display_gain_percent =
      address.integer("display_gain_percent", control.display_gain_percent, 1, 100);
  control.least_level_percent =
      address.integer("least_level_percent", control.least_level_percent, 10, 90);
  control.least_range_m = address.integer("least_range_m", control.least_range_m, 0, 100);
  control.transducer_up = address.word("transducer", "down", {"down", "up"}) == "up";
  settings.controls = address.word("control", "on", {"on", "off"}) == "on";
  settings.beam_sign = beam_sign_in(address);
  // By the maker's own words of 2010.
  constexpr int kOfImages = 120;
  if (control.output == delta_t::RecordKind::kImage &&
      (control.sector_deg != kOfImages || control.beams != kOfImages)) {
    throw StartupError("output=83B is sent with sector_deg=120 and beams=120 alone");
  }
  return settings;
}

std::vector<std::string_view> ping_file_settings() { return {"beam_sign"}; }

delta_t::BeamSign beam_sign_in(const DeviceAddress& address) {
  return address.word("beam_sign", "starboard", {"starboard", "port"}) == "port"
             ? delta_t::BeamSign::kPort
             : delta_t::BeamSign::kStarboard;
}

}  // namespace lodesman
