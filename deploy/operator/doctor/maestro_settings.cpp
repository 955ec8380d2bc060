// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/maestro_settings.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>

#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

// Indices of the parameters.
constexpr std::uint8_t kSerialMode = 3;
constexpr std::uint8_t kTimeOut = 6;  // 2 bytes
constexpr std::uint8_t kEnableCrc = 8;
constexpr std::uint8_t kNeverSuspend = 9;
// Of channel 0; those of the next one are so many further on.
constexpr std::uint8_t kHome = 30;  // 2 bytes
constexpr std::uint8_t kLeast = 32;
constexpr std::uint8_t kMost = 33;
constexpr std::uint8_t kSpeed = 37;
constexpr std::uint8_t kAcceleration = 38;
constexpr unsigned kParametersAChannel = 9;

constexpr Duration kTimeOutUnit = std::chrono::milliseconds{10};
constexpr int kLimitUnit_quarter_us = 64;
// What the driver takes for neutral when it proves the time-out.
constexpr int kNeutralTolerance_quarter_us = 1;
// What an address may say of the time-out.
constexpr double kLeastTimeOut_s = 0.3;
constexpr double kMostTimeOut_s = 0.9;

[[nodiscard]] int quarters(double pulse_us) {
  return static_cast<int>(std::lround(pulse_us * maestro::kQuartersPerMicrosecond));
}
[[nodiscard]] double microseconds(int quarter_us) {
  return quarter_us / maestro::kQuartersPerMicrosecond;
}

// Of one tab of the maker's program, and as its file of settings has it.
[[nodiscard]] std::string set_by(const std::string& in_tab, const std::string& in_file) {
  return fmt::format(
      "Maestro Control Center, {}, Apply Settings; or UscCmd --getconf box.xml, {} in it, UscCmd "
      "--configure box.xml",
      in_tab, in_file);
}

// Gathers the parameters one after the other, and knows whether one was missing.
class Reader {
 public:
  explicit Reader(const MaestroParameters& give) : give_{give} {}

  [[nodiscard]] std::uint8_t byte(unsigned index) {
    std::array<std::uint8_t, 1> bytes{};
    read(index, bytes);
    return bytes[0];
  }
  [[nodiscard]] std::uint16_t word(unsigned index) {
    std::array<std::uint8_t, 2> bytes{};
    read(index, bytes);
    return maestro::reply_value(bytes[0], bytes[1]);
  }
  [[nodiscard]] bool whole() const noexcept { return whole_; }

 private:
  void read(unsigned index, std::span<std::uint8_t> bytes) {
    whole_ = whole_ && give_(static_cast<std::uint8_t>(index), bytes);
  }

  const MaestroParameters& give_;
  bool whole_ = true;
};

[[nodiscard]] MaestroChannel read_channel(Reader& from, unsigned channel) {
  const unsigned first = kParametersAChannel * channel;
  const auto limit = [&](unsigned index) {
    return static_cast<std::uint16_t>(from.byte(first + index) * kLimitUnit_quarter_us);
  };
  MaestroChannel settings;
  settings.home_quarter_us = from.word(first + kHome);
  settings.least_quarter_us = limit(kLeast);
  settings.most_quarter_us = limit(kMost);
  settings.speed = from.byte(first + kSpeed);
  settings.acceleration = from.byte(first + kAcceleration);
  return settings;
}

// The findings of one box.
class Judgement {
 public:
  Judgement(const std::string& name, const MaestroNeeds& needs) : name_{name}, needs_{needs} {}

  void judge_serial(const MaestroSettings& settings);
  void judge_channel(unsigned number, const MaestroChannel& channel, bool reversed);
  [[nodiscard]] std::vector<Finding> findings() const;

 private:
  void add(Verdict verdict, const std::string& what, std::string remedy) {
    findings_.push_back(
        {"maestro", verdict, fmt::format("{}: {}", name_, what), std::move(remedy)});
  }
  void judge_mode(std::uint8_t mode);
  void judge_time_out(Duration time_out);
  void judge_home(unsigned number, int home_quarter_us);
  void judge_limits(unsigned number, const MaestroChannel& channel, bool reversed);

  const std::string& name_;
  const MaestroNeeds& needs_;
  std::vector<Finding> findings_;
};

void Judgement::judge_mode(std::uint8_t mode) {
  const std::string remedy =
      set_by("tab Serial Settings: USB Dual Port", "<SerialMode>USB_DUAL_PORT</SerialMode>");
  switch (mode) {
    case MaestroSettings::kUsbDualPort: return;
    case MaestroSettings::kUsbChained:
      add(Verdict::kInfo,
          "its serial mode is USB Chained: what hangs on its TX pin hears the commands too",
          remedy);
      return;
    case MaestroSettings::kUartDetect:
      add(Verdict::kBad, "its serial mode is UART, detect baud rate: it ignores what comes by USB",
          remedy);
      return;
    case MaestroSettings::kUartFixed:
      add(Verdict::kBad, "its serial mode is UART, fixed baud rate: it ignores what comes by USB",
          remedy);
      return;
    default: add(Verdict::kBad, fmt::format("its serial mode is {}, which is none", mode), remedy);
  }
}

void Judgement::judge_time_out(Duration time_out) {
  const auto units = (needs_.options.time_out + kTimeOutUnit / 2) / kTimeOutUnit;
  const Duration wanted = units * kTimeOutUnit;
  if (time_out == wanted) {
    return;
  }
  const double is_s = to_seconds(time_out);
  std::string remedy =
      set_by(fmt::format("tab Serial Settings: Timeout {:g} s", to_seconds(wanted)),
             fmt::format("<SerialTimeout>{}</SerialTimeout>", units));
  if (is_s >= kLeastTimeOut_s && is_s <= kMostTimeOut_s) {
    remedy += fmt::format("; or time_out_s={:g} in devices.thrusters", is_s);
  }
  if (time_out == Duration::zero()) {
    add(Verdict::kBad,
        "it has no serial time-out: thrust would go on for ever after the last command", remedy);
  } else {
    // A shorter one stops the boat sooner than it has to be.
    add(time_out > wanted ? Verdict::kBad : Verdict::kWarn,
        fmt::format("its serial time-out is {:g} s, and the boat counts on {:g} s", is_s,
                    to_seconds(wanted)),
        remedy);
  }
}

void Judgement::judge_serial(const MaestroSettings& settings) {
  judge_mode(settings.serial_mode);
  judge_time_out(settings.time_out);
  if (settings.crc != needs_.options.crc) {
    const bool wanted = needs_.options.crc;
    add(Verdict::kBad,
        settings.crc ? "it wants a CRC, and the driver sends none"
                     : "it wants no CRC, and the driver sends one",
        set_by(fmt::format("tab Serial Settings: Enable CRC {}", wanted ? "on" : "off"),
               fmt::format("<EnableCrc>{}</EnableCrc>", wanted)) +
            fmt::format("; or crc={} in devices.thrusters", settings.crc ? "on" : "off"));
  }
  if (!settings.never_suspend) {
    add(Verdict::kWarn, "it sleeps with the USB bus where that alone feeds it",
        set_by("tab Serial Settings: Never sleep", "<NeverSuspend>true</NeverSuspend>"));
  }
}

void Judgement::judge_home(unsigned number, int home_quarter_us) {
  const int neutral = quarters(needs_.options.neutral_us);
  const bool goes = home_quarter_us > MaestroChannel::kHomeIgnore;
  if (goes && std::abs(home_quarter_us - neutral) <= kNeutralTolerance_quarter_us) {
    return;
  }
  std::string what = home_quarter_us == MaestroChannel::kHomeOff
                         ? "sends no pulses: its speed controller disarms"
                     : home_quarter_us == MaestroChannel::kHomeIgnore
                         ? "keeps its pulse: the thrust goes on"
                         : fmt::format("goes to {:g} us, and neutral is {:g} us",
                                       microseconds(home_quarter_us), needs_.options.neutral_us);
  add(Verdict::kBad, fmt::format("on start-up and error channel {} {}", number, what),
      set_by(fmt::format("tab Channel Settings, channel {}: On startup or error Go to {:g}", number,
                         needs_.options.neutral_us),
             fmt::format("homemode=\"Goto\" home=\"{}\" of channel {}", neutral, number)));
}

// A box clips targets to its limits and says nothing; a position that is far from what was sent
// reads as a box that was reset.
void Judgement::judge_limits(unsigned number, const MaestroChannel& channel, bool reversed) {
  const double below = reversed ? needs_.most_ahead : needs_.most_astern;
  const double above = reversed ? needs_.most_astern : needs_.most_ahead;
  const MaestroOptions& options = needs_.options;
  const int least = quarters(options.neutral_us - below * options.range_us);
  const int most = quarters(options.neutral_us + above * options.range_us);
  if (channel.least_quarter_us <= least && channel.most_quarter_us >= most) {
    return;
  }
  // The box keeps multiples of a unit.
  const int outside_least = least / kLimitUnit_quarter_us * kLimitUnit_quarter_us;
  const int outside_most =
      (most + kLimitUnit_quarter_us - 1) / kLimitUnit_quarter_us * kLimitUnit_quarter_us;
  add(Verdict::kBad,
      fmt::format("channel {} is limited to {:g} to {:g} us, and thrust needs {:g} to {:g} us",
                  number, microseconds(channel.least_quarter_us),
                  microseconds(channel.most_quarter_us), microseconds(least), microseconds(most)),
      set_by(
          fmt::format("tab Channel Settings, channel {}: Min {:g}, Max {:g}", number,
                      microseconds(outside_least), microseconds(outside_most)),
          fmt::format("min=\"{}\" max=\"{}\" of channel {}", outside_least, outside_most, number)));
}

void Judgement::judge_channel(unsigned number, const MaestroChannel& channel, bool reversed) {
  judge_home(number, channel.home_quarter_us);
  judge_limits(number, channel, reversed);
  if (channel.speed != 0 || channel.acceleration != 0) {
    add(Verdict::kBad,
        fmt::format("channel {} has a limit of speed or acceleration: neutral is delayed, and "
                    "positions that lag behind read as a box that was reset",
                    number),
        set_by(fmt::format("tab Channel Settings, channel {}: Speed 0, Acceleration 0", number),
               fmt::format("speed=\"0\" acceleration=\"0\" of channel {}", number)));
  }
}

std::vector<Finding> Judgement::findings() const {
  if (!findings_.empty()) {
    return findings_;
  }
  const MaestroOptions& options = needs_.options;
  return {
      {"maestro", Verdict::kOk,
       fmt::format("{}: is set as the driver needs it, with {:g} s on channels {} and {}", name_,
                   to_seconds(options.time_out), options.left_channel, options.right_channel),
       ""}};
}

}  // namespace

MaestroNeeds maestro_needs(const std::string& address, const ThrustShapeOptions& shape) {
  constexpr std::string_view kMaestro = "maestro:";
  MaestroNeeds needs;
  try {
    if (address.starts_with(kMaestro)) {
      needs.options = maestro_options({address.substr(kMaestro.size()), maestro_settings()});
    }
    ThrustShapeOptions at_once = shape;
    at_once.slew_per_s = 0.0;
    at_once.zero_pause = Duration::zero();
    ThrustShape full{at_once};
    needs.most_ahead = full.shape(1.0, Time{});
    needs.most_astern = -full.shape(-1.0, Time{});
  } catch (const StartupError&) {  // which the configuration's own finding tells
    return {};
  }
  return needs;
}

std::optional<MaestroSettings> read_maestro(const MaestroParameters& give,
                                            const MaestroOptions& options) {
  Reader from{give};
  MaestroSettings settings;
  settings.serial_mode = from.byte(kSerialMode);
  settings.time_out = from.word(kTimeOut) * kTimeOutUnit;
  settings.crc = from.byte(kEnableCrc) != 0;
  settings.never_suspend = from.byte(kNeverSuspend) != 0;
  settings.left = read_channel(from, options.left_channel);
  settings.right = read_channel(from, options.right_channel);
  return from.whole() ? std::optional{settings} : std::nullopt;
}

std::vector<Finding> judge_maestro(const std::string& name, const MaestroSettings& settings,
                                   const MaestroNeeds& needs) {
  Judgement judgement{name, needs};
  judgement.judge_serial(settings);
  judgement.judge_channel(needs.options.left_channel, settings.left, needs.options.left_reversed);
  judgement.judge_channel(needs.options.right_channel, settings.right,
                          needs.options.right_reversed);
  return judgement.findings();
}

}  // namespace lodesman::cli
