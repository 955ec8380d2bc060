// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/fault.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "hal_sim/scenario/fault_table.h"
#include "mid_level/base/short_number.h"

namespace lodesman {
namespace {

constexpr std::size_t kMaxFaults = 64;
constexpr double kMaxFaultTime_s = 1e5;
constexpr std::size_t kMaxKindLength = 32;

constexpr std::array<std::string_view, 4> kDeviceNames{"ahrs", "thruster", "sonar", "position"};

[[nodiscard]] const FaultRow& row_of(FaultKind kind) noexcept {
  return fault_rows()[static_cast<std::size_t>(kind) - 1];
}

template <class Do>
void for_each_row(Do act) {
  for (const auto rows : {fault_rows(), further_fault_rows()}) {
    for (const FaultRow& row : rows) {
      act(row);
    }
  }
}

// The kind of that name, if the device has it.
[[nodiscard]] const FaultRow* find_row(FaultDevice device, std::string_view name) noexcept {
  const FaultRow* found = nullptr;
  for_each_row([&](const FaultRow& row) {
    if (row.name == name && row.is_of(device)) {
      found = &row;
    }
  });
  return found;
}

[[nodiscard]] std::string kinds_of(FaultDevice device) {
  std::string kinds;
  for_each_row([&](const FaultRow& row) {
    if (row.is_of(device)) {
      kinds += (kinds.empty() ? "" : ", ") + std::string{row.name};
    }
  });
  return kinds;
}

[[nodiscard]] std::string devices_of(const FaultRow& row) {
  std::string devices;
  for (std::size_t i = 0; i < kDeviceNames.size(); ++i) {
    if (row.is_of(static_cast<FaultDevice>(i))) {
      devices += (devices.empty() ? "" : ", ") + std::string{kDeviceNames[i]};
    }
  }
  return devices;
}

[[nodiscard]] double read_parameter(const TomlTable& table, std::string_view key,
                                    const FaultParameter& parameter) {
  return parameter.exists() ? table.number_or(key, Range::between(parameter.least, parameter.most),
                                              parameter.otherwise)
                            : parameter.otherwise;
}

[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  std::vector<std::string_view> words;
  for (auto from = text.find_first_not_of(kBlanks); from != std::string_view::npos;) {
    const auto to = std::min(text.find_first_of(kBlanks, from), text.size());
    words.push_back(text.substr(from, to - from));
    from = text.find_first_not_of(kBlanks, to);
  }
  return words;
}

// A whole finite number and nothing behind it.
[[nodiscard]] std::optional<double> number_of(std::string_view text) noexcept {
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(number)
             ? std::optional{number}
             : std::nullopt;
}

// One "name=number" of the text form; says why not, or nothing.
[[nodiscard]] std::string take_setting(std::string_view word, const FaultRow& row, Fault& fault) {
  struct Setting {
    std::string_view name;
    FaultParameter allowed;
    double* into;
  };
  const std::array<Setting, 4> settings{{{"rate", row.rate, &fault.rate},
                                         {"value", row.value, &fault.value},
                                         {"at", {0.0, 0.0, kMaxFaultTime_s}, &fault.at_s},
                                         {"for", {0.0, 1e-3, kMaxFaultTime_s}, &fault.duration_s}}};
  const auto equals = word.find('=');
  for (const Setting& setting : settings) {
    if (word.substr(0, equals) != setting.name || !setting.allowed.exists()) {
      continue;
    }
    const auto number =
        equals == std::string_view::npos ? std::nullopt : number_of(word.substr(equals + 1));
    if (!number || *number < setting.allowed.least || *number > setting.allowed.most) {
      return std::string{setting.name} + ": must be a number from " +
             short_number(setting.allowed.least) + " to " + short_number(setting.allowed.most);
    }
    *setting.into = *number;
    return {};
  }
  return std::string{word} + ": " + std::string{row.name} + " has no such setting";
}

}  // namespace

std::string_view name_of(FaultKind kind) noexcept {
  return kind == FaultKind::kNone ? "none" : row_of(kind).name;
}

std::string_view name_of(FaultDevice device) noexcept {
  return kDeviceNames[static_cast<std::size_t>(device)];
}

std::vector<Fault> read_faults(const TomlTable& root) {
  std::vector<Fault> faults;
  for (const TomlTable& table : root.tables("fault", kMaxFaults)) {
    Fault fault;
    fault.device =
        static_cast<FaultDevice>(table.choice("device", {"ahrs", "thruster", "sonar", "position"}));
    const FaultRow* row = find_row(fault.device, table.text("kind", kMaxKindLength));
    if (row == nullptr) {
      table.refuse("kind", "must be one of: " + kinds_of(fault.device));
    }
    fault.kind = row->kind;
    fault.at_s = table.number("at_s", Range::between(0.0, kMaxFaultTime_s));
    fault.duration_s = table.number("duration_s", Range::above(0.0, kMaxFaultTime_s));
    fault.rate = read_parameter(table, "rate", row->rate);
    fault.value = read_parameter(table, "value", row->value);
    faults.push_back(fault);
  }
  return faults;
}

ParsedFault parse_fault(std::string_view text) {
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() < 2) {
    return {std::nullopt, "must be: DEVICE KIND [rate=...] [value=...] [at=...] [for=...]"};
  }
  const auto* const name = std::find(kDeviceNames.begin(), kDeviceNames.end(), words[0]);
  if (name == kDeviceNames.end()) {
    return {std::nullopt, "device: must be one of: ahrs, thruster, sonar, position"};
  }
  Fault fault;
  fault.device = static_cast<FaultDevice>(name - kDeviceNames.begin());
  const FaultRow* row = find_row(fault.device, words[1]);
  if (row == nullptr) {
    return {std::nullopt, "kind: must be one of: " + kinds_of(fault.device)};
  }
  fault.kind = row->kind;
  fault.duration_s = kMaxFaultTime_s;
  fault.rate = row->rate.otherwise;
  fault.value = row->value.otherwise;
  for (std::size_t i = 2; i < words.size(); ++i) {
    if (std::string refusal = take_setting(words[i], *row, fault); !refusal.empty()) {
      return {std::nullopt, std::move(refusal)};
    }
  }
  return {fault, {}};
}

std::string fault_kinds_help() {
  std::string help =
      "ahrs: stall (nothing new), corrupt (samples fail their check), disconnect (gone)\n"
      "sonar: stall, corrupt, disconnect\n"
      "position: stall, corrupt, disconnect\n"
      "thruster: stall (takes commands and ignores them), disconnect (takes none); after either "
      "the box's own time-out stops both thrusters\n"
      "Of the echoes of a sonar, simulated or emulated (sim:, loop:), in images:\n";
  const auto add_rows = [&help](bool of_echoes) {
    for_each_row([&](const FaultRow& row) {
      const bool is_of_echoes =
          row.is_of(FaultDevice::kSonar) && alters_pings(FaultDevice::kSonar, row.kind);
      if (row.kind > FaultKind::kDisconnect && is_of_echoes == of_echoes) {
        help +=
            devices_of(row) + ": " + std::string{row.name} + " (" + std::string{row.help} + ")\n";
      }
    });
  };
  add_rows(true);
  help += "Of devices that are emulated to the byte (loop:), with rate or value as it says:\n";
  add_rows(false);
  return help;
}

FaultSchedule::FaultSchedule(const std::vector<Fault>& faults, FaultDevice device) {
  std::copy_if(faults.begin(), faults.end(), std::back_inserter(faults_),
               [device](const Fault& fault) {
                 return fault.device == device && !needs_bytes(fault.device, fault.kind);
               });
}

Fault FaultSchedule::running(double scenario_time_s) const noexcept {
  for (const Fault& fault : faults_) {
    if (scenario_time_s >= fault.at_s && scenario_time_s < fault.at_s + fault.duration_s) {
      return fault;
    }
  }
  return {};
}

}  // namespace lodesman
