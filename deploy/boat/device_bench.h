// SPDX-License-Identifier: Apache-2.0
// The bench without a boat: a simulated vessel with AHRS, satellite receiver, sonar and thruster
// box that are emulated to the byte, behind ptys or cables and a UDP socket, and its truth in a
// segment of its own, never in the boat's. One thread, which steps it every millisecond.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "deploy/boat/named_scenario.h"
#include "hal_sim/emulators/emulated_thrusters.h"
#include "hal_sim/emulators/utc.h"

namespace lodesman {

struct DeviceBenchOptions {
  std::string boat_segment;
  std::string hull;                 // as load_hull takes it
  std::filesystem::path directory;  // of the ptys' names: ahrs, position, thrusters
  std::string ahrs_port;            // a serial port instead of a pty; empty: a pty
  std::string position_port;
  std::string thruster_port;
  // Where the boat listens for the sonar's program; port 0: it has no sonar.
  std::string sonar_host = "127.0.0.1";
  std::uint16_t sonar_port = 0;
  ThrusterBoxKind box = ThrusterBoxKind::kMaestro;
  bool has_escs = false;
  // UTC of the devices that tell it: since 1970, at Time 0.
  Duration epoch = emulated::kVirtualEpoch;
};

// The segment in which the world of a bench for that boat tells the truth.
[[nodiscard]] std::string world_segment_of(const std::string& boat_segment);

class DeviceBench {
 public:
  // Throws StartupError.
  DeviceBench(const DeviceBenchOptions& options, const Scenario& scenario, Time now);
  DeviceBench(const DeviceBench&) = delete;
  DeviceBench& operator=(const DeviceBench&) = delete;
  ~DeviceBench();

  void step(Time now);
  // One fault more, as fault.h has it ("ahrs flip rate=0.01 for=5"), from now on; or "clear". What
  // is wrong with it, or nothing.
  [[nodiscard]] std::string order(const std::string& text);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
