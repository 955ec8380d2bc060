// SPDX-License-Identifier: Apache-2.0
// Where the programs' log goes. The main thread, before any other.
#pragma once

#include <string>

namespace lodesman {

// To standard error from now on; a reader that does not read costs lines and holds up nobody.
void log_without_blocking();
// A line on standard error for whoever started the program, in the same way.
void say(const std::string& line);

}  // namespace lodesman
