// SPDX-License-Identifier: Apache-2.0
// Lines for the system's journal, with fields that can be searched for, in its own protocol
// (https://systemd.io/JOURNAL_NATIVE_PROTOCOL). Never waits: the library's call would, where the
// journal is stuck, and with it the main thread that keeps the tasks' life told. Any thread.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace lodesman {

struct JournalField {
  std::string_view name;  // capitals, digits and underscores
  std::string value;      // any bytes
};

// Whether that stream is a pipe to the journal, as the service manager says in JOURNAL_STREAM.
[[nodiscard]] bool leads_to_the_journal(int descriptor);

// As one datagram: a field a name, whatever stands in its value.
[[nodiscard]] std::string journal_entry(std::span<const JournalField> fields);

inline constexpr const char* kJournalSocket = "/run/systemd/journal/socket";
// False where it was not taken at once.
[[nodiscard]] bool send_to_journal(std::span<const JournalField> fields,
                                   const char* socket_path = kJournalSocket);

}  // namespace lodesman
