// SPDX-License-Identifier: Apache-2.0
// The line to a real port, which may come and go. A helper thread opens it, closes it and looks for
// it again; the task that holds the line never waits for that. All but the constructor and the
// destructor is the task's; `fault` is anybody's.
//
// Who may touch the port says one atomic word:
//
//   kAbsent   the helper's      -> kOpened   by the helper, when it has opened the port
//   kOpened   the task's        -> kGivenUp  by the task, when the port is gone or not wanted
//   kGivenUp  the helper's      -> kAbsent   by the helper, when it has closed the port
//
// Each side moves the word out of its own states alone, with a release that what it has done to the
// port comes before, and looks at it with an acquire that what it then does comes after: so at any
// time one thread has the port, and sees all that the other did to it. The speed asked for is part
// of the same word, so that no port is handed over at a speed which the task has changed meanwhile.
// In kOpened the helper waits on the descriptor and does nothing else to it; it is the only one to
// close it, so what it waits on is always the port's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "drivers/stream/byte_stream.h"
#include "drivers/stream/file_descriptor.h"
#include "drivers/stream/port.h"

namespace lodesman {

class ReconnectingLine final : public ByteStream {
 public:
  // A line that takes no byte for so long, though asked to, is given up.
  static constexpr Duration kFullLimit = std::chrono::milliseconds{500};
  // Between two tries to open it, at first and at most.
  static constexpr Duration kFirstPause = std::chrono::milliseconds{100};
  static constexpr Duration kLongestPause = std::chrono::seconds{1};

  // on_bytes: called by the helper when bytes wait to be read or the port has hung up, at most
  // every millisecond; it must not block or throw. Empty: nobody is called. Throws StartupError
  // where the system gives no thread or descriptor, but not because there is no port.
  ReconnectingLine(std::string path, int baud, PortOpener open_port,
                   std::function<void()> on_bytes = {});
  ReconnectingLine(const ReconnectingLine&) = delete;
  ReconnectingLine& operator=(const ReconnectingLine&) = delete;
  // Waits for the helper: no longer than it takes to open or close the port.
  ~ReconnectingLine() override;

  [[nodiscard]] std::uint64_t connection(Time now) noexcept override;
  [[nodiscard]] Received read(std::span<std::uint8_t> into, Time now) noexcept override;
  [[nodiscard]] std::size_t write(std::span<const std::uint8_t> bytes, Time now) noexcept override;
  void reconnect(int baud) noexcept override;
  [[nodiscard]] std::uint64_t power_up() const noexcept override {
    return is_opened() ? power_up_ : 0;
  }
  [[nodiscard]] DeviceFault fault() const noexcept override;

 private:
  enum class Hold : std::int32_t { kAbsent, kOpened, kGivenUp };
  struct alignas(8) Word {  // clang takes a lock for an atomic that is not aligned to its size
    Hold hold = Hold::kAbsent;
    std::int32_t baud = 0;
  };
  static_assert(std::atomic<Word>::is_always_lock_free);

  // The task's.
  [[nodiscard]] bool is_opened() const noexcept;
  void give_up(DeviceFault why) noexcept;
  void ring() noexcept;

  // The helper's.
  void help() noexcept;
  void connect();
  void attend() noexcept;
  void disconnect() noexcept;
  void wait(Duration at_most) noexcept;
  void lengthen_pause() noexcept;

  const std::string path_;
  const PortOpener open_port_;
  const std::function<void()> on_bytes_;
  const FileDescriptor bell_;  // an eventfd: wakes the helper

  std::atomic<Word> word_;
  // Why there is no connection, in the holds without one.
  std::atomic<DeviceFault> fault_{DeviceFault::kNone};
  std::atomic<bool> stopping_{false};

  std::unique_ptr<Port> port_;     // whose it is says word_
  std::uint64_t connections_ = 0;  // the helper's to count, in kAbsent
  std::uint64_t power_up_ = 0;     // the same

  std::optional<Time> full_since_;  // the task's

  Time opened_at_{};              // the helper's
  Duration pause_ = kFirstPause;  // the helper's

  std::thread helper_;
};

}  // namespace lodesman
