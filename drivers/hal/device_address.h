// SPDX-License-Identifier: Apache-2.0
// What follows the scheme in the address of a device: "/dev/ttyUSB0?baud=57600&packet=A1" is a
// place and settings. Strict: a setting that is not asked for is refused, as is one that stands
// twice. One thread, at start-up; everything that is wrong throws StartupError.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace lodesman {

class DeviceAddress {
 public:
  // `rest`: without scheme and colon. `settings`: the names of those that there are.
  DeviceAddress(std::string_view rest, const std::vector<std::string_view>& settings);

  [[nodiscard]] const std::string& place() const noexcept { return place_; }
  [[nodiscard]] bool has(std::string_view setting) const { return values_.contains(setting); }

  // Each gives `otherwise` where the setting is left out, and refuses what lies outside its range
  // or is none of its words.
  [[nodiscard]] int integer(std::string_view setting, int otherwise, int least, int most) const;
  [[nodiscard]] double number(std::string_view setting, double otherwise, double least,
                              double most) const;
  [[nodiscard]] std::string word(std::string_view setting, std::string_view otherwise,
                                 const std::vector<std::string_view>& words) const;
  // Any text.
  [[nodiscard]] std::string text(std::string_view setting, std::string_view otherwise) const;

 private:
  std::string place_;
  std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace lodesman
