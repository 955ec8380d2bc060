// SPDX-License-Identifier: Apache-2.0
// Finds what a file of the Delta T's holds: 83B, 83P and .837 records back to back, datagrams and
// control frames, and what a head said and was told. Pure and total; any thread.
#pragma once

#include <variant>

#include "drivers/delta_t/control.h"
#include "drivers/delta_t/head.h"
#include "drivers/delta_t/raw_file.h"
#include "drivers/delta_t/record.h"

namespace lodesman::delta_t {

struct Nothing {};

struct Found {
  std::size_t size = 1;  // [-] bytes that it takes, or to skip; never 0
  bool refused = false;  // it has the tag of a record, and is none
  std::variant<Nothing, Record, RawFileRecord, SwitchCommand, HeadReply, Control> what;
};

// What stands at the beginning of bytes that are not empty. A record that says how long it is and
// whose header cannot be is refused and looked for anew from its second byte on.
[[nodiscard]] Found look_at_front(Bytes bytes) noexcept;

}  // namespace lodesman::delta_t
