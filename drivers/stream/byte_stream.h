// SPDX-License-Identifier: Apache-2.0
// A line of bytes to a device: a serial port, a pty, or a pipe in memory. Held by one task, whose
// thread alone calls it; nothing here blocks, throws, allocates or asks for the time. Whoever makes
// the connections behind it does so on a thread of its own. tests/conformance/byte_stream.cpp says
// the rest, for every implementation.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "mid_level/base/time.h"
#include "mid_level/messages/health.h"

namespace lodesman {

struct Received {
  std::size_t count = 0;  // [-] of bytes; 0: none have come
  // [ns] by when the last of them had come: known where time is simulated, else of the call.
  Time at{};
};

class ByteStream {
 public:
  ByteStream() = default;
  ByteStream(const ByteStream&) = delete;
  ByteStream& operator=(const ByteStream&) = delete;
  virtual ~ByteStream() = default;

  // The number of the connection that there is, counted up from 1 with each that is made; 0 while
  // there is none. Bytes of one have nothing to do with those of another, and none is older than
  // its connection: whoever takes frames apart begins anew with each.
  [[nodiscard]] virtual std::uint64_t connection(Time now) noexcept = 0;

  // The oldest bytes that were not given yet, as many as there are and fit. None where there is no
  // connection; that it has gone is known after a read that gives none.
  [[nodiscard]] virtual Received read(std::span<std::uint8_t> into, Time now) noexcept = 0;

  // How many of these were taken, from the first on: fewer where the line is full, none where there
  // is no connection. What was taken is on its way and cannot be taken back.
  [[nodiscard]] virtual std::size_t write(std::span<const std::uint8_t> bytes,
                                          Time now) noexcept = 0;

  // Gives the connection up; the next one is made at this speed. Means nothing where a line has no
  // speed, but that the connection is a new one.
  virtual void reconnect(int baud) noexcept = 0;

  // Of the connection there is: a number that is another one once the device at its far end was
  // without power, or the machine. 0 where that cannot be known.
  [[nodiscard]] virtual std::uint64_t power_up() const noexcept { return 0; }

  // Why there is no connection: kNone while there is one, or none was tried yet.
  [[nodiscard]] virtual DeviceFault fault() const noexcept = 0;
};

}  // namespace lodesman
