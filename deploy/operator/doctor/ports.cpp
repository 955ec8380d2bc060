// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/ports.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::array kRuleFolders{"etc/udev/rules.d", "run/udev/rules.d",
                                  "usr/local/lib/udev/rules.d", "usr/lib/udev/rules.d",
                                  "lib/udev/rules.d"};
constexpr std::string_view kPtys = "/dev/pts/";
constexpr std::string_view kDev = "/dev/";

// Where the path leads to, with the root left out; empty: nowhere.
[[nodiscard]] std::string node_of(const std::string& path, const fs::path& root) {
  std::error_code error;
  const fs::path top = fs::canonical(root, error);
  const fs::path node = fs::canonical(root / fs::path{path}.relative_path(), error);
  return error ? std::string{} : "/" + node.lexically_relative(top).string();
}

// What udev has kept of the device, found by its number: lines such as "E:ID_MM_DEVICE_IGNORE=1".
[[nodiscard]] std::vector<std::string> marks_of(const fs::path& of_kernel, const fs::path& root) {
  const std::vector<std::string> number = lines_of(of_kernel / "dev");
  return number.empty() ? number : lines_of(root / "run/udev/data" / ("c" + number.front()));
}

// The value of NAME="value" in a file that a shell reads.
[[nodiscard]] std::string setting(const fs::path& file, const std::string& name) {
  std::string value;
  for (const std::string& line : lines_of(file)) {
    if (line.starts_with(name + "=")) {
      value = line.substr(name.size() + 1);
      value.erase(std::remove(value.begin(), value.end(), '"'), value.end());
    }
  }
  return value;
}

[[nodiscard]] bool any_rule_file(const fs::path& root, std::string_view word) {
  return std::any_of(kRuleFolders.begin(), kRuleFolders.end(), [&](const char* folder) {
    const std::vector<fs::path> files = entries_of(root / folder);
    return std::any_of(files.begin(), files.end(), [&](const fs::path& file) {
      return file.extension() == ".rules" &&
             file.filename().string().find(word) != std::string::npos;
    });
  });
}

[[nodiscard]] PortFacts measure_port(const NamedPort& named, const fs::path& root) {
  PortFacts facts;
  facts.named = named;
  facts.node = node_of(named.path, root);
  if (facts.node.empty()) {
    return facts;
  }
  const fs::path here = root / fs::path{facts.node}.relative_path();
  const fs::path of_kernel = root / "sys/class/tty" / fs::path{facts.node}.filename();
  const bool in_dev = facts.node.starts_with(kDev);
  facts.terminal = facts.node.starts_with(kPtys) || (in_dev && is_there(of_kernel));
  facts.usable = is_usable(here);
  facts.group = group_of(here, root);
  facts.usb = !usb_device_of(of_kernel).empty();
  if (const auto timer = lines_of(of_kernel / "device/latency_timer"); !timer.empty()) {
    facts.latency_timer_ms = std::atoi(timer.front().c_str());
  }
  for (const std::string& mark : marks_of(of_kernel, root)) {
    facts.modem_manager_ignores |=
        mark == "E:ID_MM_DEVICE_IGNORE=1" || mark == "E:ID_MM_PORT_IGNORE=1";
    facts.handed_to_gpsd |=
        mark.starts_with("E:SYSTEMD_WANTS=") && mark.find("gpsdctl@") != std::string::npos;
  }
  std::istringstream told{setting(root / "etc/default/gpsd", "DEVICES")};
  for (std::string path; told >> path;) {
    facts.gpsd_is_told |= node_of(path, root) == facts.node;
  }
  facts.holders = holders_of(facts.node, root);
  return facts;
}

}  // namespace

std::vector<NamedPort> ports_named_in(const DeviceAddresses& devices) {
  const std::array<std::pair<const char*, const std::string*>, 4> addresses{
      {{"heading", &devices.heading},
       {"sonar", &devices.sonar},
       {"position", &devices.position},
       {"thrusters", &devices.thrusters}}};
  std::vector<NamedPort> ports;
  for (const auto& [device, address] : addresses) {
    const std::size_t colon = address->find(':');
    if (colon != std::string::npos && address->compare(colon + 1, 1, "/") == 0) {
      const std::string rest = address->substr(colon + 1);
      ports.push_back({device, address->substr(0, colon), rest.substr(0, rest.find('?'))});
    }
  }
  return ports;
}

PortsFacts measure_ports(const std::vector<NamedPort>& named, const fs::path& root) {
  PortsFacts facts;
  for (const NamedPort& port : named) {
    facts.ports.push_back(measure_port(port, root));
  }
  for (const fs::path& terminal : entries_of(root / "sys/class/tty")) {
    if (!usb_device_of(terminal).empty()) {
      facts.usb_terminals.push_back(std::string{kDev} + terminal.filename().string());
    }
  }
  facts.modem_manager = is_there(root / "usr/sbin/ModemManager");
  facts.brltty = (is_there(root / "usr/bin/brltty") || is_there(root / "bin/brltty")) &&
                 any_rule_file(root, "brltty");
  facts.gpsd_takes_usb =
      is_there(root / "usr/sbin/gpsd") && setting(root / "etc/default/gpsd", "USBAUTO") == "true";
  facts.rules = any_rule_file(root, "lodesman");
  return facts;
}

}  // namespace lodesman::cli
