// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/decode/roboclaw_lines.h"

#include <algorithm>

#include "drivers/roboclaw/packets.h"

namespace lodesman {
namespace roboclaw {
namespace {

using Bytes = std::span<const std::uint8_t>;
using Json = nlohmann::ordered_json;

constexpr std::size_t kHeadBytes = 2;  // address and command
constexpr std::size_t kCrcBytes = 2;
constexpr double kFullByte = 127.0;
constexpr double kStopByte = 64.0;

void no_fields(Json& /*json*/, Bytes /*data*/) {}

[[nodiscard]] double duty_of(Bytes data, std::size_t at) {
  return signed_of(Bytes{data}.subspan(at).first<2>()) / double{kFullDuty};
}

void fill_forward(Json& json, Bytes data) { json["duty"] = data[0] / kFullByte; }
void fill_backward(Json& json, Bytes data) { json["duty"] = -data[0] / kFullByte; }
// 0 is full astern, 64 stop and 127 full ahead: the two sides have not the same number of steps.
void fill_drive(Json& json, Bytes data) {
  const double offset = data[0] - kStopByte;
  json["duty"] = offset / (offset > 0.0 ? kFullByte - kStopByte : kStopByte);
}
void fill_duty(Json& json, Bytes data) { json["duty"] = duty_of(data, 0); }
void fill_duties(Json& json, Bytes data) {
  json["duty_1"] = duty_of(data, 0);
  json["duty_2"] = duty_of(data, 2);
}
void fill_time_out(Json& json, Bytes data) { json["time_out_s"] = data[0] * kTimeOutUnit_s; }

struct Kind {
  Command command;
  const char* type;
  std::size_t data_bytes;  // 0: a question, without CRC
  void (*fill)(Json& json, Bytes data);
};

constexpr Kind kKinds[] = {
    {Command::kForward1, "forward_1", 1, fill_forward},
    {Command::kBackward1, "backward_1", 1, fill_backward},
    {Command::kForward2, "forward_2", 1, fill_forward},
    {Command::kBackward2, "backward_2", 1, fill_backward},
    {Command::kDrive1, "drive_1", 1, fill_drive},
    {Command::kDrive2, "drive_2", 1, fill_drive},
    {Command::kSetTimeOut, "set_time_out", 1, fill_time_out},
    {Command::kReadTimeOut, "read_time_out", 0, no_fields},
    {Command::kReadVersion, "read_version", 0, no_fields},
    {Command::kReadMainBattery, "read_main_battery", 0, no_fields},
    {Command::kReadLogicBattery, "read_logic_battery", 0, no_fields},
    {Command::kDuty1, "duty_1", 2, fill_duty},
    {Command::kDuty2, "duty_2", 2, fill_duty},
    {Command::kDutyBoth, "duty_both", 4, fill_duties},
    {Command::kReadDuties, "read_duties", 0, no_fields},
    {Command::kReadCurrents, "read_currents", 0, no_fields},
    {Command::kReadTemperature1, "read_temperature_1", 0, no_fields},
    {Command::kReadTemperature2, "read_temperature_2", 0, no_fields},
    {Command::kReadStatus, "read_status", 0, no_fields},
};

[[nodiscard]] const Kind* kind_of(std::uint8_t command) {
  const auto found = std::find_if(
      std::begin(kKinds), std::end(kKinds),
      [command](const Kind& kind) { return static_cast<std::uint8_t>(kind.command) == command; });
  return found == std::end(kKinds) ? nullptr : found;
}

[[nodiscard]] bool is_address(std::uint8_t byte) {
  return byte >= kFirstAddress && byte <= kLastAddress;
}

// How many bytes the packet has that stands at the beginning, and what it says; 0: none does.
[[nodiscard]] std::size_t decode(Bytes bytes, Json& json) {
  if (bytes[0] == kAcknowledge) {
    json = {{"type", "acknowledge"}, {"known", true}};
    return 1;
  }
  const Kind* kind = bytes.size() < kHeadBytes ? nullptr : kind_of(bytes[1]);
  if (kind == nullptr) {
    return 0;
  }
  const std::size_t body = kHeadBytes + kind->data_bytes;
  const std::size_t size = body + (kind->data_bytes > 0 ? kCrcBytes : 0);
  if (bytes.size() < size ||
      (size > body && crc16(bytes.first(body)) != unsigned_of(bytes.subspan(body, 2)))) {
    return 0;
  }
  json = {{"type", kind->type}, {"known", true}, {"address", bytes[0]}, {"command", bytes[1]}};
  kind->fill(json, bytes.subspan(kHeadBytes, kind->data_bytes));
  return size;
}

}  // namespace
}  // namespace roboclaw

DecodeCounts roboclaw_lines(std::span<const std::uint8_t> bytes,
                            const std::function<void(const nlohmann::ordered_json&)>& line) {
  DecodeCounts counts;
  while (!bytes.empty()) {
    nlohmann::ordered_json json;
    const bool begins = roboclaw::is_address(bytes[0]) || bytes[0] == roboclaw::kAcknowledge;
    const std::size_t size = begins ? roboclaw::decode(bytes, json) : 0;
    if (size > 0) {
      ++counts.packets;
      line(json);
    } else {
      counts.refused += begins ? 1 : 0;
      ++counts.skipped_bytes;
    }
    bytes = bytes.subspan(std::max<std::size_t>(size, 1));
  }
  return counts;
}

}  // namespace lodesman
