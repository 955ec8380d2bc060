// SPDX-License-Identifier: Apache-2.0
// Changes inputs as chance has it, the same on every machine.
#pragma once

#include <random>
#include <span>
#include <string>

namespace lodesman::fuzz {

// `seed` with one to four changes: bytes flipped, cut out, doubled, cut off, or words of `others`
// and numbers at the edge of what can be held put in.
[[nodiscard]] std::string mutated(const std::string& seed, std::span<const std::string> others,
                                  std::mt19937_64& chance);

}  // namespace lodesman::fuzz
