// SPDX-License-Identifier: Apache-2.0
// What every target holds its reader to.
#pragma once

#include <stdexcept>
#include <string>

#include "mid_level/base/startup_error.h"

namespace lodesman::fuzz {

// A reader that did what it may not. Nothing catches it in a target.
class Violation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

void require(bool good, const std::string& what);

// One line `file:line: key: reason` of bounded length, without a control character.
void require_refusal_form(const std::string& refusal);

// Runs `read`, which may refuse as start-up does.
template <class Read>
void accepted_or_refused(Read read) {
  try {
    read();
  } catch (const StartupError& error) {
    require_refusal_form(error.what());
  }
}

}  // namespace lodesman::fuzz
