// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/scenario/fault.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>

#include "mid_level/base/short_number.h"

namespace lodesman {
namespace {

constexpr std::size_t kMaxFaults = 64;
constexpr double kMaxFaultTime_s = 1e5;
constexpr std::size_t kMaxKindLength = 32;

constexpr std::array<std::string_view, 4> kDeviceNames{"ahrs", "thruster", "sonar", "position"};

// A number that belongs to a fault: what it is when it is left out, and from where to where it may
// be. None where both ends are the same.
struct Parameter {
  double otherwise = 0.0;
  double least = 0.0;
  double most = 0.0;

  [[nodiscard]] constexpr bool exists() const noexcept { return least < most; }
};
constexpr Parameter kNoNumber{};

// Which devices have a kind.
constexpr unsigned kA = 1U << static_cast<unsigned>(FaultDevice::kAhrs);
constexpr unsigned kT = 1U << static_cast<unsigned>(FaultDevice::kThruster);
constexpr unsigned kSensors = kA | 1U << static_cast<unsigned>(FaultDevice::kSonar) |
                              1U << static_cast<unsigned>(FaultDevice::kPosition);

struct Row {
  FaultKind kind;
  std::string_view name;
  unsigned devices;
  Parameter rate;
  Parameter value;
  std::string_view help;
};

constexpr Parameter chance(double otherwise) noexcept { return {otherwise, 0.0, 1.0}; }

// In the order of FaultKind.
constexpr std::array<Row, kFaultKindCount - 1> kRows{{
    {FaultKind::kStall, "stall", kSensors | kT, kNoNumber, kNoNumber, ""},
    {FaultKind::kCorrupt, "corrupt", kSensors, kNoNumber, kNoNumber, ""},
    {FaultKind::kDisconnect, "disconnect", kSensors | kT, kNoNumber, kNoNumber, ""},
    {FaultKind::kFlip, "flip", kA | kT, chance(1e-4), kNoNumber,
     "rate: chance of a byte to become another"},
    {FaultKind::kBurst, "burst", kA | kT, chance(0.3), kNoNumber,
     "rate: the same, in bad spells of 20 ms after 10 s on the average"},
    {FaultKind::kDrop, "drop", kA | kT, chance(1e-4), kNoNumber,
     "rate: chance of a byte to be lost"},
    {FaultKind::kDuplicate, "duplicate", kA | kT, chance(1e-4), kNoNumber,
     "rate: chance of a byte to come twice"},
    {FaultKind::kInsert, "insert", kA | kT, chance(1e-4), kNoNumber,
     "rate: chance of a byte that nobody sent"},
    {FaultKind::kInterference, "interference", kA | kT, chance(1e-3), kNoNumber,
     "rate: chance of a byte to become another at full thrust; it grows with thrust squared"},
    {FaultKind::kCut, "cut", kA | kT, chance(0.05), kNoNumber,
     "rate: chance of a frame to end early"},
    {FaultKind::kLate,
     "late",
     kA | kT,
     chance(0.05),
     {0.1, 0.0, 10.0},
     "rate: chance of an answer to come one to three times value [s] too late"},
    {FaultKind::kBatch,
     "batch",
     kA | kT,
     kNoNumber,
     {0.016, 0.0, 1.0},
     "value [s]: an adapter hands on at multiples of it, or 62 bytes"},
    {FaultKind::kHang,
     "hang",
     kA | kT,
     {1.0, 0.0, 600.0},
     kNoNumber,
     "rate [a minute]: of silences of 50 ms to 30 s"},
    {FaultKind::kReplug,
     "replug",
     kA | kT,
     {1.0, 0.0, 600.0},
     kNoNumber,
     "rate [a minute]: of being gone for 0.1 to 5 s"},
    {FaultKind::kPower, "power", kA | kT, kNoNumber, kNoNumber, "off, and on again at the end"},
    {FaultKind::kFrozen, "frozen", kA, kNoNumber, kNoNumber, "the same values again and again"},
    {FaultKind::kStep,
     "step",
     kA,
     kNoNumber,
     {45.0, -180.0, 180.0},
     "value [deg]: the heading is off"},
    {FaultKind::kDrift,
     "drift",
     kA,
     kNoNumber,
     {0.5, -10.0, 10.0},
     "value [deg/s]: the heading wanders off"},
    {FaultKind::kSpike,
     "spike",
     kA,
     chance(0.01),
     {45.0, -180.0, 180.0},
     "rate: chance of a packet whose heading is off by value [deg]"},
    {FaultKind::kInvalid, "invalid", kA, kNoNumber, kNoNumber, "the most negative values"},
    {FaultKind::kMagnetic,
     "magnetic",
     kA,
     kNoNumber,
     {10.0, -180.0, 180.0},
     "value [deg]: the heading is off at full thrust, and in proportion to it"},
    {FaultKind::kBit,
     "bit",
     kA,
     kNoNumber,
     {1.0, 0.0, 65535.0},
     "value: what the built-in test says"},
    {FaultKind::kError,
     "error",
     kT,
     {0.2, 0.0, 100.0},
     kNoNumber,
     "rate [a second]: of errors that the box reports"},
    {FaultKind::kReset, "reset", kT, kNoNumber, kNoNumber, "forgets once what it was told"},
    {FaultKind::kRefuse,
     "refuse",
     kT,
     kNoNumber,
     {0.0, 0.0, 23.0},
     "value: the channel whose targets are ignored"},
    {FaultKind::kNoTimeOut, "no_time_out", kT, kNoNumber, kNoNumber, "does not stop by itself"},
    {FaultKind::kWrongMode, "wrong_mode", kT, kNoNumber, kNoNumber, "ignores everything"},
    {FaultKind::kBattery, "battery", kT, kNoNumber, {21.0, 0.0, 60.0}, "value [V]: of the battery"},
}};

[[nodiscard]] const Row& row_of(FaultKind kind) noexcept {
  return kRows[static_cast<std::size_t>(kind) - 1];
}

[[nodiscard]] bool has(FaultDevice device, const Row& row) noexcept {
  return ((row.devices >> static_cast<unsigned>(device)) & 1U) != 0;
}

// The kind of that name, if the device has it.
[[nodiscard]] const Row* find_row(FaultDevice device, std::string_view name) noexcept {
  const auto* const row = std::find_if(kRows.begin(), kRows.end(), [&](const Row& candidate) {
    return candidate.name == name && has(device, candidate);
  });
  return row == kRows.end() ? nullptr : row;
}

[[nodiscard]] std::string kinds_of(FaultDevice device) {
  std::string kinds;
  for (const Row& row : kRows) {
    if (has(device, row)) {
      kinds += (kinds.empty() ? "" : ", ") + std::string{row.name};
    }
  }
  return kinds;
}

[[nodiscard]] double read_parameter(const TomlTable& table, std::string_view key,
                                    const Parameter& parameter) {
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
[[nodiscard]] std::string take_setting(std::string_view word, const Row& row, Fault& fault) {
  struct Setting {
    std::string_view name;
    Parameter allowed;
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
    const Row* row = find_row(fault.device, table.text("kind", kMaxKindLength));
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
  const Row* row = find_row(fault.device, words[1]);
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
      "Of devices that are emulated to the byte (loop:), with rate or value as it says:\n";
  for (const Row& row : kRows) {
    if (needs_bytes(row.kind)) {
      const std::string devices = row.devices == kA   ? "ahrs"
                                  : row.devices == kT ? "thruster"
                                                      : "ahrs, thruster";
      help += devices + ": " + std::string{row.name} + " (" + std::string{row.help} + ")\n";
    }
  }
  return help;
}

FaultSchedule::FaultSchedule(const std::vector<Fault>& faults, FaultDevice device) {
  std::copy_if(
      faults.begin(), faults.end(), std::back_inserter(faults_),
      [device](const Fault& fault) { return fault.device == device && !needs_bytes(fault.kind); });
}

FaultKind FaultSchedule::at(double scenario_time_s) const noexcept {
  for (const Fault& fault : faults_) {
    if (scenario_time_s >= fault.at_s && scenario_time_s < fault.at_s + fault.duration_s) {
      return fault.kind;
    }
  }
  return FaultKind::kNone;
}

}  // namespace lodesman
