// SPDX-License-Identifier: Apache-2.0
// Writes lines for people to a descriptor that nobody may be reading: a full pipe or a stopped
// terminal costs a line and never a moment. Any thread may write.
#pragma once

#include <cstdint>
#include <string_view>

namespace lodesman {

class NonblockingStream {
 public:
  enum class Written : std::uint8_t {
    kWhole,
    kDropped,  // nobody reads it now
    kFailed,   // it cannot be written at all: closed, broken, full
  };

  // Pipes and terminals are opened anew where that is possible, so that nobody else's descriptor
  // changes its ways; the descriptor itself stays the caller's.
  explicit NonblockingStream(int descriptor) noexcept;
  NonblockingStream(const NonblockingStream&) = delete;
  NonblockingStream& operator=(const NonblockingStream&) = delete;
  ~NonblockingStream();

  [[nodiscard]] Written write(std::string_view text) const noexcept;

 private:
  [[nodiscard]] bool would_block() const noexcept;

  int descriptor_;
  int own_;  // -1: the caller's is written to
};

}  // namespace lodesman
