// SPDX-License-Identifier: Apache-2.0
// What keeps the boat from its serial ports, judged from their facts, and the command that mends
// it. Pure functions; any thread.
#pragma once

#include <string>
#include <vector>

#include "deploy/operator/doctor/diagnosis.h"
#include "deploy/operator/doctor/ports.h"

namespace lodesman::cli {

// The command that installs the rules of deploy/udev, and what lets this user at a node of a group.
[[nodiscard]] std::string install_rules();
[[nodiscard]] std::string permission_remedy(const std::string& group);

// Each port that is named has one finding at least; then what is shared, and the machine.
[[nodiscard]] std::vector<Finding> judge_ports(const PortsFacts& facts);

}  // namespace lodesman::cli
