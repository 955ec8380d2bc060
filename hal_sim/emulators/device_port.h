// SPDX-License-Identifier: Apache-2.0
// The real end of an emulated device's wire: a pty that the boat finds under a name that stays, or
// a serial port with a cable to another one. One thread, of a program that has nothing else to do:
// calls may allocate, and none waits.
#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "drivers/stream/port.h"
#include "hal_sim/emulators/line_feed.h"

namespace lodesman {

// What bytes go in and out by, towards the boat.
class HostLine {
 public:
  HostLine() = default;
  HostLine(const HostLine&) = delete;
  HostLine& operator=(const HostLine&) = delete;
  virtual ~HostLine() = default;

  [[nodiscard]] virtual std::size_t read(std::span<std::uint8_t> into) = 0;
  [[nodiscard]] virtual std::size_t write(std::span<const std::uint8_t> bytes) = 0;
  // Whether somebody is there who could read; where that cannot be told, yes.
  [[nodiscard]] virtual bool has_host() = 0;
  // [Bd] that the host speaks at; `device`: the device's own, for where that cannot be told.
  [[nodiscard]] virtual int host_baud(int device) = 0;
  virtual void unplug() = 0;
  virtual void plug() = 0;
};

// A pty, and a link to it at `name`, which goes while it is unplugged. Throws StartupError.
[[nodiscard]] std::unique_ptr<HostLine> make_pty_line(const std::filesystem::path& name);
// A serial port at the device's speed. `open`: how one is opened. Throws StartupError where it
// cannot be; a cable is not unplugged by a fault, but falls silent.
[[nodiscard]] std::unique_ptr<HostLine> make_cable_line(const std::string& path, int baud,
                                                        PortOpener open);

// A device at the end of such a line.
class DevicePort {
 public:
  DevicePort(FaultyDevice& device, EmulatedWire& wire, std::unique_ptr<HostLine> line)
      : device_{device}, wire_{wire}, line_{std::move(line)} {}

  // Time never falls; called every millisecond or so.
  void pump(Time now);

 private:
  // A second and more of any of these lines: what nobody reads is lost from then on.
  static constexpr std::size_t kMaxHeld = 16384;

  FaultyDevice& device_;
  EmulatedWire& wire_;
  std::unique_ptr<HostLine> line_;
  bool plugged_ = true;
  std::deque<TimedByte> held_;
  std::vector<TimedByte> to_host_;
};

}  // namespace lodesman
