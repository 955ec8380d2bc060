// SPDX-License-Identifier: Apache-2.0
// The serial ports that a configuration names, and what there is on this machine that may keep the
// boat from them, as plain facts. One thread; nothing is opened, so no device notices.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "deploy/boat/configuration.h"
#include "deploy/operator/doctor/system_files.h"

namespace lodesman::cli {

struct NamedPort {
  std::string device;  // its key in [devices]
  std::string scheme;
  std::string path;
};
// The addresses of the form scheme:/path?settings.
[[nodiscard]] std::vector<NamedPort> ports_named_in(const DeviceAddresses& devices);

struct PortFacts {
  NamedPort named;
  std::string node;  // that the path leads to; empty: nowhere
  bool terminal = false;
  bool usable = false;  // by this user, to read and to write
  std::string group;    // that it belongs to
  bool usb = false;
  std::optional<int> latency_timer_ms;  // of FTDI's chips alone
  bool modem_manager_ignores = false;   // as udev has marked it
  bool handed_to_gpsd = false;          // by udev at plug-in
  bool gpsd_is_told = false;            // by name, in gpsd's own settings
  std::vector<PortHolder> holders;      // as far as this user may see
};

struct PortsFacts {
  std::vector<PortFacts> ports;            // that are named, in the order of the configuration
  std::vector<std::string> usb_terminals;  // that there are
  bool modem_manager = false;              // is installed
  bool brltty = false;                     // is installed, with rules that give it USB adapters
  bool gpsd_takes_usb = false;             // is installed, and takes what udev hands to it
  bool rules = false;                      // of this project are installed
};

// root: where /dev, /sys, /proc, /etc, /run and /usr are looked for.
[[nodiscard]] PortsFacts measure_ports(const std::vector<NamedPort>& named,
                                       const std::filesystem::path& root = "/");

}  // namespace lodesman::cli
