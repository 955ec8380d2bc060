// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/maestro_lines.h"

#include <algorithm>

#include "drivers/maestro/commands.h"

namespace lodesman {
namespace maestro {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Json = nlohmann::ordered_json;

constexpr std::uint8_t kFirstCommand = 0x80;
constexpr double kPwmUnit_us = 1.0 / 48.0;

[[nodiscard]] int word_of(Bytes data, std::size_t at) { return data[at] | data[at + 1] << 7; }
[[nodiscard]] double pulse_us(Bytes data, std::size_t at) {
  return word_of(data, at) * kPulseStep_us;
}

struct Kind {
  std::uint8_t command;
  const char* type;
  std::size_t data_bytes;
  void (*fill)(Json& json, Bytes data);
};

void no_fields(Json& /*json*/, Bytes /*data*/) {}
void fill_channel(Json& json, Bytes data) { json["channel"] = data[0]; }
void fill_target(Json& json, Bytes data) {
  fill_channel(json, data);
  json["pulse_us"] = pulse_us(data, 1);
}
// In the box's own units: what a step is depends on its pulse period.
void fill_limit(Json& json, Bytes data) {
  fill_channel(json, data);
  json["limit"] = word_of(data, 1);
}
void fill_pwm(Json& json, Bytes data) {
  json["on_us"] = word_of(data, 0) * kPwmUnit_us;
  json["period_us"] = word_of(data, 2) * kPwmUnit_us;
}
void fill_targets(Json& json, Bytes data) {
  json["channel"] = data[1];
  json["pulses_us"] = Json::array();
  for (std::size_t at = 2; at < data.size(); at += 2) {
    json["pulses_us"].push_back(pulse_us(data, at));
  }
}
void fill_subroutine(Json& json, Bytes data) { json["subroutine"] = data[0]; }
void fill_subroutine_with(Json& json, Bytes data) {
  fill_subroutine(json, data);
  json["parameter"] = word_of(data, 1);
}

constexpr Kind kKinds[] = {
    {kSetTarget, "set_target", 3, fill_target},
    {kSetSpeed, "set_speed", 3, fill_limit},
    {kSetAcceleration, "set_acceleration", 3, fill_limit},
    {kSetPwm, "set_pwm", 4, fill_pwm},
    {kGetPosition, "get_position", 1, fill_channel},
    {kGetMoving, "get_moving", 0, no_fields},
    {kSetTargets, "set_targets", 2, fill_targets},  // and two more a channel
    {kGetErrors, "get_errors", 0, no_fields},
    {kGoHome, "go_home", 0, no_fields},
    {kStopScript, "stop_script", 0, no_fields},
    {kRunSubroutine, "run_subroutine", 1, fill_subroutine},
    {kRunSubroutineWith, "run_subroutine_with", 3, fill_subroutine_with},
    {kScriptStatus, "script_status", 0, no_fields},
};

[[nodiscard]] const Kind* kind_of(unsigned command) {
  const auto found = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [command](const Kind& kind) { return kind.command == command; });
  return found == std::end(kKinds) ? nullptr : found;
}

// How many data bytes stand at the beginning.
[[nodiscard]] std::size_t data_run(Bytes bytes) {
  const auto end = std::find_if(bytes.begin(), bytes.end(),
                                [](std::uint8_t byte) { return byte >= kFirstCommand; });
  return static_cast<std::size_t>(end - bytes.begin());
}

class Decoder {
 public:
  explicit Decoder(const std::function<void(const Json&)>& line) : line_{line} {}

  // Takes what stands at the beginning, and says how many bytes that was: at least one.
  std::size_t take(Bytes bytes) {
    if (bytes[0] < kFirstCommand) {
      return skip(1);
    }
    if (bytes[0] == kMiniSsc) {
      return mini_ssc(bytes);
    }
    if (bytes[0] == kPololuProtocol) {
      return pololu(bytes);
    }
    return packet(bytes, 1, bytes[0], "compact", Json::object());
  }

  [[nodiscard]] const DecodeCounts& counts() const { return counts_; }

 private:
  std::size_t skip(std::size_t count) {
    counts_.skipped_bytes += count;
    return count;
  }
  std::size_t refuse(std::size_t count) {
    ++counts_.refused;
    return skip(count);
  }
  void give(const Json& json) {
    ++counts_.packets;
    line_(json);
  }

  // Its three bytes hold 8 bits each, and it never has a check.
  std::size_t mini_ssc(Bytes bytes) {
    if (bytes.size() < 3) {
      return refuse(bytes.size());
    }
    give({{"type", "mini_ssc"}, {"known", true}, {"channel", bytes[1]}, {"target", bytes[2]}});
    return 3;
  }

  std::size_t pololu(Bytes bytes) {
    if (data_run(bytes.subspan(1)) == 0) {
      give({{"type", "detect_baud"}, {"known", true}});
      return 1;
    }
    if (data_run(bytes.subspan(1)) == 1) {
      return refuse(2);
    }
    return packet(bytes, 3, bytes[2] | kFirstCommand, "pololu", {{"device", bytes[1]}});
  }

  // Whose data begins at `head`.
  std::size_t packet(Bytes bytes, std::size_t head, unsigned command, const char* form,
                     const Json& addressed) {
    const std::size_t run = data_run(bytes.subspan(head));
    const Kind* kind = kind_of(command);
    Json json;
    json["type"] = kind != nullptr ? kind->type : "command";
    json["known"] = kind != nullptr;
    json["form"] = form;
    json.update(addressed);
    if (kind == nullptr) {
      json["command"] = command;
      json["data"] = bytes.subspan(head, run);
      give(json);
      return head + run;
    }
    std::size_t data_bytes = kind->data_bytes;
    if (command == kSetTargets && run > 0) {
      data_bytes += std::size_t{2} * bytes[head];
    }
    if (run < data_bytes) {
      return refuse(head + run);
    }
    const std::size_t size = head + data_bytes;
    if (run > data_bytes) {  // one more: a check, or a byte too many
      const bool right = bytes[size] == crc7(bytes.first(size));
      if (!right && checks_) {
        return refuse(size + 1);
      }
      checks_ = checks_ || right;
      if (right) {
        json["crc"] = bytes[size];
      }
    } else if (checks_) {
      return refuse(size);
    }
    kind->fill(json, bytes.subspan(head, data_bytes));
    give(json);
    return size + (json.contains("crc") ? 1 : 0);
  }

  const std::function<void(const Json&)>& line_;
  DecodeCounts counts_;
  bool checks_ = false;  // a right one was seen
};

}  // namespace
}  // namespace maestro

DecodeCounts maestro_lines(std::span<const std::uint8_t> bytes,
                           const std::function<void(const nlohmann::ordered_json&)>& line) {
  maestro::Decoder decoder{line};
  while (!bytes.empty()) {
    bytes = bytes.subspan(decoder.take(bytes));
  }
  return decoder.counts();
}

}  // namespace lodesman
