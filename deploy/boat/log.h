// SPDX-License-Identifier: Apache-2.0
// Where the programs' log goes: to standard error, and where that is the system's journal, there.
// The main thread, before any other.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "deploy/boat/journal.h"

namespace lodesman {

// From now on; a reader that does not read costs lines and holds up nobody. Before the journal a
// line has its level as sd-daemon(3) wants it, and no time, which the journal has by itself.
void log_without_blocking();
enum class LineLevel : std::uint8_t { kInfo, kWarning };
// A line with fields for the journal, where that is read; elsewhere the line alone.
void log_with_fields(LineLevel line_level, const std::string& line,
                     std::span<const JournalField> fields);
// A line on standard error for whoever started the program, in the same way.
void say(const std::string& line);

}  // namespace lodesman
