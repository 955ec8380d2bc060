// SPDX-License-Identifier: Apache-2.0
// An open port, whatever system calls it takes. Made and destroyed by a helper thread, for both may
// take long; in between one task has it, whose calls do not block, throw or allocate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "mid_level/messages/health.h"

namespace lodesman {

class Port {
 public:
  Port() = default;
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;
  virtual ~Port() = default;

  // 0 of either may mean "not now" or "gone": is_gone() is to be asked then.
  [[nodiscard]] virtual std::size_t read(std::span<std::uint8_t> into) noexcept = 0;
  [[nodiscard]] virtual std::size_t write(std::span<const std::uint8_t> bytes) noexcept = 0;
  [[nodiscard]] virtual bool is_gone() const noexcept = 0;
  // To wait on. Of use as long as the port is there.
  [[nodiscard]] virtual int descriptor() const noexcept = 0;
};

struct OpenedPort {
  std::unique_ptr<Port> port;              // empty where it could not be opened
  DeviceFault fault = DeviceFault::kNone;  // why
  std::uint64_t power_up = 0;              // ByteStream::power_up
};

// May block and allocate; baud: [bit/s].
using PortOpener = std::function<OpenedPort(const std::string& path, int baud)>;

}  // namespace lodesman
