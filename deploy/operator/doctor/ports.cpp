// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/doctor/ports.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
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

[[nodiscard]] std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream{file};
  std::vector<std::string> lines;
  std::string line;
  while (std::getline(stream, line)) {
    lines.push_back(line);
  }
  return lines;
}

[[nodiscard]] bool is_there(const fs::path& path) {
  std::error_code error;
  return fs::exists(path, error);
}

// What cannot be listed has nothing in it.
[[nodiscard]] std::vector<fs::path> entries_of(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> entries;
  for (fs::directory_iterator entry{folder, error}; !error && entry != fs::directory_iterator{};
       entry.increment(error)) {
    entries.push_back(entry->path());
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

[[nodiscard]] bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

// Where the path leads to, with the root left out; empty: nowhere.
[[nodiscard]] std::string node_of(const std::string& path, const fs::path& root) {
  std::error_code error;
  const fs::path top = fs::canonical(root, error);
  const fs::path node = fs::canonical(root / fs::path{path}.relative_path(), error);
  return error ? std::string{} : "/" + node.lexically_relative(top).string();
}

[[nodiscard]] std::string group_name(gid_t group, const fs::path& root) {
  std::string number = std::to_string(group);
  for (const std::string& line : lines_of(root / "etc/group")) {
    std::istringstream fields{line};
    std::array<std::string, 3> field;
    for (std::string& one : field) {
      std::getline(fields, one, ':');
    }
    if (field[2] == number) {
      return field[0];
    }
  }
  return number;
}

[[nodiscard]] bool is_usb(const fs::path& of_kernel) {
  std::error_code error;
  fs::path place = fs::canonical(of_kernel / "device", error);
  for (; !error && place.has_relative_path(); place = place.parent_path()) {
    if (is_there(place / "idVendor")) {
      return true;
    }
  }
  return false;
}

// What udev has kept of the device, found by its number: lines such as "E:ID_MM_DEVICE_IGNORE=1".
[[nodiscard]] std::vector<std::string> marks_of(const fs::path& of_kernel, const fs::path& root) {
  const std::vector<std::string> number = lines_of(of_kernel / "dev");
  return number.empty() ? number : lines_of(root / "run/udev/data" / ("c" + number.front()));
}

[[nodiscard]] std::vector<PortHolder> holders_of(const std::string& node, const fs::path& root) {
  std::vector<PortHolder> holders;
  for (const fs::path& process : entries_of(root / "proc")) {
    if (!is_number(process.filename().string())) {
      continue;
    }
    const std::vector<fs::path> open = entries_of(process / "fd");
    if (std::any_of(open.begin(), open.end(), [&](const fs::path& descriptor) {
          std::error_code error;
          return fs::read_symlink(descriptor, error) == node;
        })) {
      const std::vector<std::string> name = lines_of(process / "comm");
      holders.push_back({name.empty() ? "?" : name.front(), process.filename().string()});
    }
  }
  return holders;
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
  facts.usable = faccessat(AT_FDCWD, here.c_str(), R_OK | W_OK, AT_EACCESS) == 0;
  struct stat status {};
  if (stat(here.c_str(), &status) == 0) {
    facts.group = group_name(status.st_gid, root);
  }
  facts.usb = is_usb(of_kernel);
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
    if (is_usb(terminal)) {
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
