// SPDX-License-Identifier: Apache-2.0
#include "drivers/gpsd/reports.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "drivers/gpsd/json_members.h"
#include "mid_level/base/heading.h"
#include "mid_level/base/time.h"

namespace lodesman::gpsd {
namespace {

using Member = JsonMembers::Member;

[[nodiscard]] std::optional<double> number_within(const Member& member, double least,
                                                  double most) noexcept {
  const std::optional<double> value = number_of(member);
  return value && *value >= least && *value <= most ? value : std::nullopt;
}

[[nodiscard]] std::optional<int> whole_of(const Member& member, int most) noexcept {
  const std::optional<double> value = number_within(member, 0.0, most);
  return value ? std::optional{static_cast<int>(std::lround(*value))} : std::nullopt;
}

[[nodiscard]] std::optional<double> course_of(const Member& member) noexcept {
  const std::optional<double> deg = number_within(member, 0.0, 360.0);
  return deg ? std::optional{wrap_to_pi(to_rad(*deg))} : std::nullopt;
}

[[nodiscard]] std::string_view text_of(const Member& member) noexcept {
  return member.kind == JsonMembers::Kind::kText ? member.value : std::string_view{};
}

void fill(Tpv& tpv, const Member& member) noexcept {
  const std::string_view name = member.name;
  if (name == "device") {
    tpv.device = text_of(member);
  } else if (name == "mode") {
    tpv.mode = whole_of(member, 3).value_or(0);
  } else if (name == "status") {
    tpv.status = whole_of(member, 100).value_or(0);
  } else if (name == "time") {
    tpv.utc_ns = utc_of(text_of(member));
  } else if (name == "lat") {
    tpv.latitude_deg = number_within(member, -90.0, 90.0);
  } else if (name == "lon") {
    tpv.longitude_deg = number_within(member, -180.0, 180.0);
  } else if (name == "eph") {
    tpv.eph_m = number_within(member, 0.0, 1e6);
  } else if (name == "speed") {
    tpv.speed_m_s = number_within(member, 0.0, 1000.0);
  } else if (name == "track") {
    tpv.course_rad = course_of(member);
  }
}

void fill(Sky& sky, const Member& member) noexcept {
  if (member.name == "device") {
    sky.device = text_of(member);
  } else if (member.name == "hdop") {
    sky.hdop = number_within(member, 0.0, 100.0);
  } else if (member.name == "uSat") {
    sky.used = whole_of(member, 1000);
  }
}

void fill(Att& att, const Member& member) noexcept {
  if (member.name == "device") {
    att.device = text_of(member);
  } else if (member.name == "heading") {
    att.heading_rad = course_of(member);
  }
}

void fill(Devices& devices, const Member& member) noexcept {
  if (member.name == "devices") {
    devices.any = member.value.find('{') != std::string_view::npos;
  }
}

// One that was closed has 0 where another has the time of its opening.
void fill(Device& device, const Member& member) noexcept {
  if (member.name == "path") {
    device.path = text_of(member);
  } else if (member.name == "activated") {
    const std::optional<double> number = number_of(member);
    device.active = number ? *number > 0.0 : !text_of(member).empty();
  }
}

void fill(Version& version, const Member& member) noexcept {
  if (member.name == "release") {
    version.release = text_of(member);
  } else if (member.name == "proto_major") {
    version.protocol_major = whole_of(member, 1000).value_or(0);
  } else if (member.name == "proto_minor") {
    version.protocol_minor = whole_of(member, 1000).value_or(0);
  }
}

template <class Kind>
[[nodiscard]] Report filled(std::string_view line) noexcept {
  Kind report;
  JsonMembers members{line};
  while (const auto member = members.next()) {
    fill(report, *member);
  }
  return report;
}

[[nodiscard]] std::optional<std::string_view> class_of(std::string_view line) noexcept {
  std::optional<std::string_view> found;
  JsonMembers members{line};
  while (const auto member = members.next()) {
    if (member->name == "class" && !found) {
      found = text_of(*member);
    }
  }
  return members.sound() ? found : std::nullopt;
}

// So many digits from `at` on, and that they are.
struct Digits {
  int value = 0;
  bool sound = true;
};
[[nodiscard]] Digits digits_at(std::string_view text, std::size_t at, std::size_t count) noexcept {
  Digits digits;
  for (std::size_t i = at; i < at + count; ++i) {
    const bool is_digit = text[i] >= '0' && text[i] <= '9';
    digits.sound = digits.sound && is_digit;
    digits.value = digits.value * 10 + (is_digit ? text[i] - '0' : 0);
  }
  return digits;
}

}  // namespace

std::optional<std::int64_t> utc_of(std::string_view text) noexcept {
  constexpr std::string_view kForm = "0000-00-00T00:00:00";
  constexpr std::size_t kMostDigits = 9;  // of a second
  if (text.size() <= kForm.size() || text.back() != 'Z' || text[4] != '-' || text[7] != '-' ||
      text[10] != 'T' || text[13] != ':' || text[16] != ':') {
    return std::nullopt;
  }
  const Digits year = digits_at(text, 0, 4);
  const Digits month = digits_at(text, 5, 2);
  const Digits day = digits_at(text, 8, 2);
  const Digits hour = digits_at(text, 11, 2);
  const Digits minute = digits_at(text, 14, 2);
  const Digits second = digits_at(text, 17, 2);
  std::int64_t part_ns = 0;
  const std::string_view part = text.substr(kForm.size(), text.size() - 1 - kForm.size());
  if (!part.empty()) {
    const std::size_t count = std::min(part.size() - 1, kMostDigits);
    const Digits digits = digits_at(part, 1, count);
    if (part[0] != '.' || count == 0 || !digits.sound) {
      return std::nullopt;
    }
    part_ns = digits.value;
    for (std::size_t i = count; i < kMostDigits; ++i) {
      part_ns *= 10;
    }
  }
  const std::chrono::year_month_day date{std::chrono::year{year.value},
                                         std::chrono::month{static_cast<unsigned>(month.value)},
                                         std::chrono::day{static_cast<unsigned>(day.value)}};
  const bool sound = year.sound && month.sound && day.sound && hour.sound && minute.sound &&
                     second.sound && date.ok() && year.value >= 1970 && year.value < 2200 &&
                     hour.value < 24 && minute.value < 60 && second.value <= 60;
  if (!sound) {
    return std::nullopt;
  }
  const Duration since = std::chrono::sys_days{date}.time_since_epoch() +
                         std::chrono::hours{hour.value} + std::chrono::minutes{minute.value} +
                         std::chrono::seconds{second.value};
  return since.count() + part_ns;
}

Report decoded(std::string_view line) noexcept {
  const std::optional<std::string_view> kind = class_of(line);
  if (!kind) {
    return Broken{};
  }
  return *kind == "TPV"       ? filled<Tpv>(line)
         : *kind == "SKY"     ? filled<Sky>(line)
         : *kind == "ATT"     ? filled<Att>(line)
         : *kind == "DEVICES" ? filled<Devices>(line)
         : *kind == "DEVICE"  ? filled<Device>(line)
         : *kind == "VERSION" ? filled<Version>(line)
                              : Report{Other{}};
}

}  // namespace lodesman::gpsd
