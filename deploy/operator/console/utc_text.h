// SPDX-License-Identifier: Apache-2.0
// The time of day for people. Any thread.
#pragma once

#include <string>

namespace lodesman::console {

// As ISO 8601, to the millisecond; empty where the machine's clock is not set.
[[nodiscard]] std::string utc_text();

}  // namespace lodesman::console
