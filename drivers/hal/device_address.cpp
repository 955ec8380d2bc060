// SPDX-License-Identifier: Apache-2.0
#include "drivers/hal/device_address.h"

#include <algorithm>
#include <charconv>

#include "mid_level/base/short_number.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

[[noreturn]] void refuse(std::string_view setting, const std::string& reason) {
  throw StartupError("setting " + std::string{setting} + " of the address " + reason);
}

[[nodiscard]] std::string listed(const std::vector<std::string_view>& words) {
  std::string list;
  for (const std::string_view word : words) {
    list.append(list.empty() ? "" : ", ").append(word);
  }
  return list;
}

template <class Number>
[[nodiscard]] Number parsed(std::string_view setting, const std::string& text, Number least,
                            Number most, const std::string& kind) {
  Number value{};
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  // What is not a number is not between the two.
  if (error != std::errc{} || stopped != end || !(value >= least && value <= most)) {
    refuse(setting, "must be " + kind + " from " + short_number(static_cast<double>(least)) +
                        " to " + short_number(static_cast<double>(most)) + ", not \"" + text +
                        "\"");
  }
  return value;
}

}  // namespace

DeviceAddress::DeviceAddress(std::string_view rest, const std::vector<std::string_view>& settings) {
  const auto mark = rest.find('?');
  place_ = rest.substr(0, mark);
  if (mark == std::string_view::npos) {
    return;
  }
  std::string_view left = rest.substr(mark + 1);
  while (true) {
    const auto end = left.find('&');
    const std::string_view pair = left.substr(0, end);
    const auto equals = pair.find('=');
    const std::string_view name = pair.substr(0, equals);
    if (std::find(settings.begin(), settings.end(), name) == settings.end()) {
      throw StartupError("\"" + std::string{name} + "\" is no setting of this address; there " +
                         (settings.empty() ? "are none" : "are " + listed(settings)));
    }
    if (equals == std::string_view::npos || equals + 1 == pair.size()) {
      refuse(name, "needs a value");
    }
    if (!values_.emplace(name, pair.substr(equals + 1)).second) {
      refuse(name, "stands twice");
    }
    if (end == std::string_view::npos) {
      return;
    }
    left = left.substr(end + 1);
  }
}

int DeviceAddress::integer(std::string_view setting, int otherwise, int least, int most) const {
  const auto found = values_.find(setting);
  return found == values_.end() ? otherwise
                                : parsed(setting, found->second, least, most, "a whole number");
}

double DeviceAddress::number(std::string_view setting, double otherwise, double least,
                             double most) const {
  const auto found = values_.find(setting);
  return found == values_.end() ? otherwise
                                : parsed(setting, found->second, least, most, "a number");
}

std::string DeviceAddress::word(std::string_view setting, std::string_view otherwise,
                                const std::vector<std::string_view>& words) const {
  const auto found = values_.find(setting);
  if (found == values_.end()) {
    return std::string{otherwise};
  }
  if (std::find(words.begin(), words.end(), found->second) == words.end()) {
    refuse(setting, "must be one of " + listed(words) + ", not \"" + found->second + "\"");
  }
  return found->second;
}

std::string DeviceAddress::text(std::string_view setting, std::string_view otherwise) const {
  const auto found = values_.find(setting);
  return found == values_.end() ? std::string{otherwise} : found->second;
}

}  // namespace lodesman
