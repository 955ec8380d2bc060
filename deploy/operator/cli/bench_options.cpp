// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/bench_options.h"

#include <fmt/format.h>

#include <cstdlib>

#include "deploy/boat/device_catalogue.h"
#include "deploy/boat/free_port.h"
#include "deploy/boat/named_scenario.h"
#include "deploy/boat/program_options.h"

namespace lodesman::cli {
namespace fs = std::filesystem;
namespace {

// The receiver of the bench, as it is set.
constexpr const char* kReceiver = "?baud=38400&latency_s=0.04";

}  // namespace

std::vector<std::string> arguments_of(const BenchOptions& bench, const fs::path& ports) {
  std::vector<std::string> arguments{"--ports", ports.string(), "--box",
                                     bench.box, "--sonar-port", std::to_string(bench.sonar_port)};
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) {
      arguments.insert(arguments.end(), {option, value});
    }
  };
  add("--ahrs-port", bench.bench_ahrs_port);
  add("--position-port", bench.bench_position_port);
  add("--thruster-port", bench.bench_thruster_port);
  add("--control", bench.control);
  return arguments;
}

void set_bench(const BenchOptions& bench, const fs::path& ports, CommonOptions& common) {
  const auto port = [&](const std::string& cable, const char* name) {
    return cable.empty() ? (ports / name).string() : cable;
  };
  common.sets.insert(
      common.sets.begin(),
      {"devices.heading=" + toml_string("nav440:" + port(bench.ahrs_port, "ahrs")),
       "devices.sonar=" + toml_string("delta_t:127.0.0.1?port=" + std::to_string(bench.sonar_port)),
       "devices.position=" +
           toml_string("nmea:" + port(bench.position_port, "position") + kReceiver),
       "devices.thrusters=" +
           toml_string(bench.box + ":" + port(bench.thruster_port, "thrusters"))});
}

void set_bench_world(const BoatConfig& configuration, const std::string& scenario,
                     CommonOptions& common) {
  const Scenario bench = load_named_scenario(scenario, configuration.speeds);
  const bool simulates = simulated_device(configuration.devices) != nullptr;
  std::vector<std::string> sets{
      simulates ? "simulation.vessel=estimate" : "simulation.vessel=bench", "origin.at_start=false",
      fmt::format("origin.deg=[{}, {}]", bench.environment.origin_latitude_deg,
                  bench.environment.origin_longitude_deg)};
  if (bench.position.source == PositionSource::kDeadReckoning) {
    sets.emplace_back("estimator.position_source=dead_reckoning");
  }
  common.sets.insert(common.sets.begin(), sets.begin(), sets.end());
}

void add_bench_options(CLI::App& command, BenchOptions& bench) {
  command.add_option("--ahrs-port", bench.ahrs_port, "A port instead of a pty: the boat's end")
      ->type_name("PORT");
  command.add_option("--position-port", bench.position_port, "The same")->type_name("PORT");
  command.add_option("--thruster-port", bench.thruster_port, "The same")->type_name("PORT");
  command.add_option("--bench-ahrs-port", bench.bench_ahrs_port, "The other end of that cable")
      ->type_name("PORT");
  command.add_option("--bench-position-port", bench.bench_position_port, "The same")
      ->type_name("PORT");
  command.add_option("--bench-thruster-port", bench.bench_thruster_port, "The same")
      ->type_name("PORT");
  add_port_option(command, "--sonar-port", bench.sonar_port, "UDP port of the boat [a free one]");
  command.add_option("--box", bench.box, "maestro or roboclaw")
      ->check(CLI::IsMember({"maestro", "roboclaw"}));
  command.add_option("--control", bench.control, "A named pipe to make: a line a fault, or clear")
      ->type_name("FILE");
}

void complete(BenchOptions& bench) {
  if (bench.ahrs_port.empty() != bench.bench_ahrs_port.empty() ||
      bench.position_port.empty() != bench.bench_position_port.empty() ||
      bench.thruster_port.empty() != bench.bench_thruster_port.empty()) {
    throw CLI::ValidationError("hil",
                               "a cable has two ends: give --ahrs-port with --bench-ahrs-port, "
                               "--position-port with --bench-position-port, --thruster-port with "
                               "--bench-thruster-port");
  }
  if (bench.sonar_port == 0) {
    bench.sonar_port = free_udp_port();
  }
}

PortsDirectory::PortsDirectory(bool needed) {
  std::string pattern = (fs::temp_directory_path() / "lodesman-hil-XXXXXX").string();
  if (needed) {
    if (mkdtemp(pattern.data()) == nullptr) {
      throw StartupError("hil: " + pattern + ": cannot be made");
    }
    path_ = pattern;
  }
}

PortsDirectory::~PortsDirectory() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace lodesman::cli
