// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/doctor_command.h"

#include <fmt/format.h>

#include <memory>

#include "deploy/operator/cli/common_options.h"
#include "deploy/operator/doctor/diagnosis.h"
#include "deploy/operator/doctor/gpsd.h"
#include "deploy/operator/doctor/machine.h"
#include "deploy/operator/doctor/maestro_boxes.h"
#include "deploy/operator/doctor/port_diagnosis.h"
#include "deploy/operator/doctor/ports.h"
#include "deploy/operator/doctor/receive_buffer.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

struct Wanted {
  std::vector<NamedPort> ports;
  MaestroNeeds box;
  std::string position;  // its address
  std::string sonar;     // the same
};

// Nothing where the configuration cannot be read, of which the machine's findings tell.
[[nodiscard]] Wanted wanted_by(const CommonOptions& options) {
  try {
    const BoatConfig config = load_configuration("default", options);
    return {ports_named_in(config.devices),
            maestro_needs(config.devices.thrusters, config.thrust_shape), config.devices.position,
            config.devices.sonar};
  } catch (const StartupError&) {
    return {};
  }
}

[[nodiscard]] std::vector<Finding> all_findings(const CommonOptions& options) {
  std::vector<Finding> findings = judge(measure_machine(options));
  const auto add = [&findings](const std::vector<Finding>& more) {
    findings.insert(findings.end(), more.begin(), more.end());
  };
  const Wanted wanted = wanted_by(options);
  const PortsFacts ports = measure_ports(wanted.ports);
  add(judge_ports(ports));
  add(judge_maestros(measure_maestros(ports, wanted.box), wanted.box));
  if (const auto buffer = measure_receive_buffer(wanted.sonar)) {
    findings.push_back(judge_receive_buffer(*buffer));
  }
  if (const auto gpsd = measure_gpsd(wanted.position)) {
    findings.push_back(judge_gpsd(*gpsd));
  }
  return findings;
}

[[nodiscard]] int doctor(const CommonOptions& options) {
  using Json = nlohmann::ordered_json;
  const std::vector<Finding> findings = all_findings(options);
  const bool bad = any_bad(findings);
  if (options.json) {
    Json list = Json::array();
    for (const Finding& finding : findings) {
      list.push_back(finding.to_json());
    }
    const Json document{{"ok", !bad}, {"findings", std::move(list)}};
    fmt::print("{}\n", document.dump(-1, ' ', false, Json::error_handler_t::replace));
  } else {
    for (const Finding& finding : findings) {
      // What needs doing is said even to those who want quiet.
      if (!options.quiet || finding.verdict >= Verdict::kWarn) {
        fmt::print("{}\n", finding.line());
      }
    }
  }
  return bad ? kExitFault : kExitDone;
}

}  // namespace

void add_doctor_command(CLI::App& root, int& exit_status) {
  const auto options = std::make_shared<CommonOptions>();
  CLI::App* command =
      root.add_subcommand("doctor", "What this machine lacks, with the command that mends it");
  add_common_options(*command, *options);
  command->footer(
      "Example: lodesman doctor --config boat.toml   # its ports, thruster box and gpsd\n\n"
      "Exit status 4 where something is bad.");
  command->callback([options, &exit_status] { exit_status = doctor(*options); });
}

}  // namespace lodesman::cli
