// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/port_diagnosis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace lodesman::cli {
namespace {

constexpr const char* kInstallRules =
    "sudo install -m 644 deploy/udev/60-lodesman.rules /etc/udev/rules.d/ && sudo udevadm control "
    "--reload && sudo udevadm trigger --action=add";

[[nodiscard]] std::string name_of(const PortFacts& port) {
  return port.named.path == port.node || port.node.empty()
             ? port.named.path
             : fmt::format("{} ({})", port.named.path, port.node);
}

[[nodiscard]] Finding bad(const PortFacts& port, const std::string& what, std::string remedy) {
  return {port.named.device, Verdict::kBad, name_of(port) + what, std::move(remedy)};
}

[[nodiscard]] Finding warning(const PortFacts& port, const std::string& what, std::string remedy) {
  return {port.named.device, Verdict::kWarn, name_of(port) + what, std::move(remedy)};
}

void judge_holders(const PortFacts& port, std::vector<Finding>& findings) {
  for (const PortHolder& holder : port.holders) {
    const std::string what = fmt::format(" is held by {} ({})", holder.program, holder.process);
    if (holder.program.starts_with("lodesman")) {
      findings.push_back({port.named.device, Verdict::kInfo, name_of(port) + what, ""});
    } else {
      findings.push_back(bad(port, what, "sudo kill " + holder.process));
    }
  }
}

void judge_dangers(const PortFacts& port, const PortsFacts& machine,
                   std::vector<Finding>& findings) {
  if (port.latency_timer_ms.value_or(0) > 1) {
    findings.push_back(
        warning(port, fmt::format(" keeps what it receives for {} ms", *port.latency_timer_ms),
                fmt::format("echo 1 | sudo tee /sys/class/tty/{}/device/latency_timer, and for "
                            "good: {}",
                            port.node.substr(port.node.rfind('/') + 1), kInstallRules)));
  }
  if (port.usb && machine.modem_manager && !port.modem_manager_ignores) {
    findings.push_back(
        warning(port, " may be taken for a modem by ModemManager at plug-in", kInstallRules));
  }
  if (port.usb && machine.brltty) {
    findings.push_back(warning(port, " may be taken for a Braille display by brltty at plug-in",
                               "sudo apt-get remove brltty"));
  }
  if (machine.gpsd_takes_usb && port.handed_to_gpsd) {
    findings.push_back(warning(port, " is handed to gpsd at plug-in", kInstallRules));
  }
  if (port.gpsd_is_told) {
    findings.push_back(
        bad(port, " is one of gpsd's DEVICES",
            "take it out of DEVICES in /etc/default/gpsd; sudo systemctl restart gpsd"));
  }
}

void judge_port(const PortFacts& port, const PortsFacts& machine, std::vector<Finding>& findings) {
  const std::size_t before = findings.size();
  if (port.node.empty()) {
    findings.push_back(
        bad(port, " is not there",
            "plug it in; ls -l /dev/lodesman /dev/serial/by-id shows what is there"));
    return;
  }
  if (!port.terminal) {
    findings.push_back(
        bad(port, " is no serial port", fmt::format("name one in devices.{}", port.named.device)));
    return;
  }
  if (!port.usable) {
    findings.push_back(
        bad(port, fmt::format(" may not be read and written: it belongs to group {}", port.group),
            permission_remedy(port.group)));
  }
  judge_holders(port, findings);
  judge_dangers(port, machine, findings);
  if (findings.size() == before) {
    findings.push_back({port.named.device, Verdict::kOk, name_of(port) + " is there", ""});
  }
}

// One driver may serve two contracts over one port, two drivers may not.
void judge_sharing(const PortsFacts& facts, std::vector<Finding>& findings) {
  for (std::size_t second = 0; second < facts.ports.size(); ++second) {
    for (std::size_t first = 0; first < second; ++first) {
      const PortFacts& one = facts.ports[first];
      const PortFacts& other = facts.ports[second];
      if (!one.node.empty() && one.node == other.node && one.named.scheme != other.named.scheme) {
        findings.push_back(bad(other, " is also devices." + one.named.device,
                               fmt::format("give devices.{} or devices.{} another port",
                                           one.named.device, other.named.device)));
      }
    }
  }
}

[[nodiscard]] Finding judge_machine(const PortsFacts& facts) {
  if (facts.usb_terminals.empty()) {
    return {"serial_ports", Verdict::kInfo, "no USB serial port is plugged in", ""};
  }
  std::vector<std::string> takers;
  for (const auto& [there, name] :
       {std::pair{facts.modem_manager, "ModemManager"}, std::pair{facts.brltty, "brltty"},
        std::pair{facts.gpsd_takes_usb, "gpsd"}}) {
    if (there) {
      takers.emplace_back(name);
    }
  }
  const std::string there = fmt::format("{}", fmt::join(facts.usb_terminals, " "));
  if (takers.empty() || facts.rules) {
    return {"serial_ports", Verdict::kInfo, there, ""};
  }
  return {"serial_ports", Verdict::kInfo,
          fmt::format("{}; some may be taken at plug-in by {}", there, fmt::join(takers, ", ")),
          kInstallRules};
}

}  // namespace

std::string install_rules() { return kInstallRules; }

// root's and tty's are no groups to join: the device is to be given to another.
std::string permission_remedy(const std::string& group) {
  return group.empty() || group == "root" || group == "tty"
             ? install_rules()
             : fmt::format("sudo usermod -aG {} $USER; log in again", group);
}

std::vector<Finding> judge_ports(const PortsFacts& facts) {
  std::vector<Finding> findings;
  for (const PortFacts& port : facts.ports) {
    judge_port(port, facts, findings);
  }
  judge_sharing(facts, findings);
  findings.push_back(judge_machine(facts));
  return findings;
}

}  // namespace lodesman::cli
