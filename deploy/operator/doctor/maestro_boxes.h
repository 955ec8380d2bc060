// SPDX-License-Identifier: Apache-2.0
// The Maestros of this machine: the one that the configuration names, by the USB device of its
// port, and those that are plugged in beside it; which of them may be asked for its settings, and
// what there is to say of each. One thread.
//
// A box whose port is held is not asked: it is not known whether the question sets its serial
// time-out anew, which is to be proved, or to stop the boat, by silence.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/doctor/maestro_usb.h"
#include "deploy/operator/doctor/ports.h"

namespace lodesman::cli {

struct MaestroFacts {
  enum class Port : std::uint8_t {
    kCommand,  // its first one
    kTtl,      // its second one, which takes no commands
    kOther,    // not one of a Maestro's
  };
  std::string name;    // of the box and its port
  bool named = false;  // by the configuration
  Port port = Port::kCommand;
  unsigned channels = 0;              // that it has
  std::string group;                  // of its USB node
  std::vector<PortHolder> holders;    // of any of its ports
  std::optional<MaestroAnswer> said;  // where it was asked
};

using AskMaestro =
    std::function<MaestroAnswer(const std::string& node, const MaestroOptions& options)>;

// root: as of measure_ports.
[[nodiscard]] std::vector<MaestroFacts> measure_maestros(const PortsFacts& ports,
                                                         const MaestroNeeds& needs,
                                                         const std::filesystem::path& root = "/",
                                                         const AskMaestro& ask = ask_maestro);

// What is wrong with a box that no configuration names is a warning at most.
[[nodiscard]] std::vector<Finding> judge_maestros(const std::vector<MaestroFacts>& boxes,
                                                  const MaestroNeeds& needs);

}  // namespace lodesman::cli
