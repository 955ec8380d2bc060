// SPDX-License-Identifier: Apache-2.0
// Lines that carry their number and a code over both, so that whoever listens can neither alter nor
// add, drop, repeat or reorder one unseen. They can be read by everybody. One session's, one
// thread. The format to the byte: docs/wire/command_socket.md.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "high_level/mission/message_code.h"

namespace lodesman {

// The keys of one session, one for each way.
struct SessionKeys {
  Digest to_boat{};
  Digest to_client{};
};

enum class SessionEnd : std::uint8_t { kBoat, kClient };

class SealedLines {
 public:
  // As this end of the session.
  SealedLines(const SessionKeys& keys, SessionEnd end) noexcept;

  // The next line to send, without its line feed. `object`: a JSON object with a member, as
  // nlohmann::json writes it on one line.
  [[nodiscard]] std::string seal(std::string_view object);
  // The object in the next line that came, without its line feed. Nothing where it is not exactly
  // what the other end sealed next: the session is then at its end.
  [[nodiscard]] std::optional<std::string> open(std::string_view line);

 private:
  Digest own_key_;
  Digest other_key_;
  std::uint64_t sealed_ = 0;
  std::uint64_t opened_ = 0;
};

}  // namespace lodesman
