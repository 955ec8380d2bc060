// SPDX-License-Identifier: Apache-2.0
// What is wrong with a machine, judged from its facts, and the command that mends it. Pure
// functions; any thread.
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "deploy/operator/doctor/machine.h"

namespace lodesman::cli {

enum class Verdict : std::uint8_t {
  kOk,
  kInfo,  // worth knowing, nothing to mend
  kWarn,  // works, not as well as it could
  kBad,   // no boat will sail
};
[[nodiscard]] const char* to_string(Verdict verdict) noexcept;

struct Finding {
  std::string name;
  Verdict verdict = Verdict::kOk;
  std::string what;
  std::string remedy;  // a command or a place to look; empty where nothing is to be done

  [[nodiscard]] nlohmann::ordered_json to_json() const;
  [[nodiscard]] std::string line() const;
};

[[nodiscard]] std::vector<Finding> judge(const MachineFacts& facts);
[[nodiscard]] bool any_bad(std::span<const Finding> findings) noexcept;

}  // namespace lodesman::cli
