// SPDX-License-Identifier: Apache-2.0
#include "drivers/delta_t/scan.h"

#include <algorithm>

namespace lodesman::delta_t {
namespace {

[[nodiscard]] Found look_at_record(Bytes bytes) noexcept {
  const std::size_t length = record_length(bytes);
  if (length > 0 && length <= bytes.size()) {
    if (const Parsed parsed = parse_record(bytes.first(length)); parsed.refusal == Refusal::kNone) {
      return {length, false, parsed.record};
    }
  }
  return {1, true, {}};
}

}  // namespace

Found look_at_front(Bytes bytes) noexcept {
  switch (bytes[0]) {
    case '8':
      if (const auto raw = raw_file_record_in(bytes)) {
        return {raw->length, false, *raw};
      }
      if (parse_record(bytes.first(std::min<std::size_t>(bytes.size(), 3))).refusal !=
          Refusal::kUnknownTag) {
        return look_at_record(bytes);
      }
      break;
    case 'I':
      if (const auto reply = head_reply_in(bytes)) {
        return {kReplyBytes, false, *reply};
      }
      break;
    case 'E':
      if (const auto control = control_in(bytes)) {
        return {kControlBytes, false, *control};
      }
      break;
    case 0xFE:
      if (const auto command = switch_command_in(bytes)) {
        return {kSwitchBytes, false, *command};
      }
      break;
    default: break;
  }
  return {};
}

}  // namespace lodesman::delta_t
