// SPDX-License-Identifier: Apache-2.0
#include "drivers/nav440/options.h"

#include <algorithm>
#include <charconv>
#include <string>

#include "drivers/nav440/framing.h"
#include "mid_level/base/heading.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// 100 Hz by the dividers 1, 2, 4, 5, 10, 20, 25 and 50.
constexpr std::array<int, 8> kRates_hz{100, 50, 25, 20, 10, 5, 4, 2};
constexpr double kMostDeclination_deg = 180.0;
constexpr double kMostLatency_s = 0.1;

struct PacketWord {
  std::string_view word;
  Nav440Packet packet;
};
constexpr std::array<PacketWord, 5> kPacketWords{{{"auto", Nav440Packet::kAuto},
                                                  {"A0", Nav440Packet::kA0},
                                                  {"A1", Nav440Packet::kA1},
                                                  {"N0", Nav440Packet::kN0},
                                                  {"N1", Nav440Packet::kN1}}};

[[nodiscard]] Nav440Packet packet_of(const DeviceAddress& address) {
  std::vector<std::string_view> words;
  words.reserve(kPacketWords.size());
  for (const PacketWord& word : kPacketWords) {
    words.push_back(word.word);
  }
  const std::string word = address.word("packet", words.front(), words);
  return std::find_if(kPacketWords.begin(), kPacketWords.end(),
                      [&](const PacketWord& one) { return one.word == word; })
      ->packet;
}

[[nodiscard]] int baud_of(const DeviceAddress& address) {
  const std::string word = address.word("baud", "57600", {"9600", "19200", "38400", "57600"});
  int baud = 0;
  std::from_chars(word.data(), word.data() + word.size(), baud);
  return baud;
}

[[nodiscard]] std::string listed_rates() {
  std::string list;
  for (const int rate_hz : kRates_hz) {
    list += (list.empty() ? "" : ", ") + std::to_string(rate_hz);
  }
  return list;
}

// "rate_hz=50 would, or baud=57600", of what there is.
[[nodiscard]] std::string what_fits(nav440::PacketType type, const Nav440Options& options) {
  std::string fits;
  for (const int rate_hz : kRates_hz) {
    if (rate_hz <= nav440::most_packets_hz(type, options.baud)) {
      fits = "rate_hz=" + std::to_string(rate_hz) + " fits";
      break;
    }
  }
  for (auto speed = kNav440Speeds_baud.rbegin(); speed != kNav440Speeds_baud.rend(); ++speed) {
    if (options.rate_hz <= nav440::most_packets_hz(type, *speed)) {
      return fits + ", and so does baud=" + std::to_string(*speed);
    }
  }
  return fits;
}

}  // namespace

nav440::PacketType nav440::first_choice(Nav440Packet packet) noexcept {
  switch (packet) {
    case Nav440Packet::kA0: return kA0;
    case Nav440Packet::kN0: return kN0;
    case Nav440Packet::kN1: return kN1;
    case Nav440Packet::kA1:
    case Nav440Packet::kAuto: break;
  }
  return kA1;
}

int nav440::most_packets_hz(PacketType type, int baud) noexcept {
  constexpr int kLongestOfOurs = 42;
  int payload = 0;
  while (payload < kLongestOfOurs && !may_be_long(type, static_cast<std::size_t>(payload))) {
    ++payload;
  }
  return baud /
         (Nav440Framing::kBitsOfByte * (payload + static_cast<int>(Nav440Framing::kOverhead)));
}

std::vector<std::string_view> nav440_settings() {
  return {"baud", "packet", "rate_hz", "declination_deg", "latency_s"};
}

void check_nav440_options(const Nav440Options& options) {
  if (std::find(kRates_hz.begin(), kRates_hz.end(), options.rate_hz) == kRates_hz.end()) {
    throw StartupError("setting rate_hz of the address must be one of " + listed_rates() +
                       ", not \"" + std::to_string(options.rate_hz) + "\"");
  }
  const nav440::PacketType type = nav440::first_choice(options.packet);
  const int most_hz = nav440::most_packets_hz(type, options.baud);
  if (options.line_has_speed && options.rate_hz > most_hz) {
    const std::string letters{static_cast<char>(type >> 8U), static_cast<char>(type & 0xFFU)};
    throw StartupError("packet " + letters + " at " + std::to_string(options.rate_hz) +
                       " Hz does not fit a line of " + std::to_string(options.baud) +
                       " Bd, which carries " + std::to_string(most_hz) +
                       " of them a second: " + what_fits(type, options));
  }
}

Nav440Options nav440_options(const DeviceAddress& address) {
  Nav440Options options;
  options.baud = baud_of(address);
  options.packet = packet_of(address);
  options.rate_hz =
      address.integer("rate_hz", options.rate_hz, kRates_hz.back(), kRates_hz.front());
  options.declination_rad =
      to_rad(address.number("declination_deg", 0.0, -kMostDeclination_deg, kMostDeclination_deg));
  options.latency = from_seconds(address.number("latency_s", 0.0, 0.0, kMostLatency_s));
  check_nav440_options(options);
  return options;
}

}  // namespace lodesman
