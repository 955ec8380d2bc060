// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/titles.h"

#include "deploy/operator/report/numbers.h"

namespace lodesman::cli {

std::string outcome_words(const RunResult& result) {
  if (result.outcome == "goal") {
    return "goal reached";
  }
  if (result.outcome == "time_limit") {
    return "time limit";
  }
  return result.outcome;
}

std::string picture_title(const RunResult& result) {
  const std::string profile = result.profile.empty() ? "" : ", profile " + result.profile;
  const char* estimated =
      result.counted_from == CountedFrom::kEstimate ? ", by the boat's own estimate" : "";
  return result.scenario + profile + ": " + outcome_words(result) + ", " + fixed(result.time_s, 1) +
         " s" + estimated;
}

}  // namespace lodesman::cli
