// SPDX-License-Identifier: Apache-2.0
// What `lodesman segment` says of a frame on standard output where nobody asked for JSON. The main
// thread.
#pragma once

#include <nlohmann/json.hpp>

namespace lodesman::cli {

// A frame as the JSON has it.
void print_frame(const nlohmann::ordered_json& frame);

}  // namespace lodesman::cli
