// SPDX-License-Identifier: Apache-2.0
// What `lodesman hil` has beside `lodesman sim`: the real drivers on the devices of
// lodesman-devices, over ptys or cables and a UDP port. One thread, at start-up; what is wrong
// throws.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "deploy/boat/configuration.h"

namespace lodesman::cli {

struct BenchOptions {
  std::string ahrs_port;            // a serial port that a cable leads to; empty: a pty
  std::string position_port;        // the same
  std::string thruster_port;        // the same
  std::string bench_ahrs_port;      // the cable's other end; empty: a pty
  std::string bench_position_port;  // the same
  std::string bench_thruster_port;  // the same
  std::uint16_t sonar_port = 0;     // UDP, of the boat; 0: one that is free
  std::string box = "maestro";
  std::string control;  // a named pipe for faults
};

void add_bench_options(CLI::App& command, BenchOptions& bench);
// Refuses a cable with one end, and finds a port for the sonar.
void complete(BenchOptions& bench);

// What lodesman-devices is told. `ports`: where its ptys have their names.
[[nodiscard]] std::vector<std::string> arguments_of(const BenchOptions& bench,
                                                    const std::filesystem::path& ports);

// The devices of a bench. First, so that whoever says otherwise has it otherwise.
void set_bench(const BenchOptions& bench, const std::filesystem::path& ports,
               CommonOptions& common);

// Where the bench's world is, and what its boat goes by: the scenario's fixes, or its own reckoning
// where the scenario wants that. A device that is simulated in the boat itself has its world there.
void set_bench_world(const BoatConfig& configuration, const std::string& scenario,
                     CommonOptions& common);

// Where the ptys of a bench have their names: short, and gone with the run.
class PortsDirectory {
 public:
  // Throws StartupError where none can be made.
  explicit PortsDirectory(bool needed);
  PortsDirectory(const PortsDirectory&) = delete;
  PortsDirectory& operator=(const PortsDirectory&) = delete;
  ~PortsDirectory();
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace lodesman::cli
