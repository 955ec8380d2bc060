// SPDX-License-Identifier: Apache-2.0
// What became of the decisions that were made again. Plain data.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mid_level/blackboard/wake_edges.h"
#include "mid_level/recording/raw_difference.h"

namespace lodesman::cli {

enum class DifferenceKind : std::uint8_t {
  kField,         // both published, and a field differs
  kNotPublished,  // the recorded step published it, the replayed one did not
  kPublished,     // the other way round
};

struct Difference {
  TaskId task = TaskId::kWorld;
  std::string channel;
  std::uint64_t sequence = 0;  // of the recorded publication; 0: there is none
  Time stamp{};
  DifferenceKind kind = DifferenceKind::kField;
  FieldDifference field{};  // the first
};

// Why what a task decided is not judged.
enum class Doubt : std::uint8_t {
  kBeginning,  // it was at work before the recording begins: what it remembered is not known
  kGap,        // something that it saw, or one of its steps, is not in the recording
  kTorn,       // something that it saw was written over while it looked
  kForeign,    // it read other channels than this build's task does
  kNoStep,     // published outside of any recorded step, as when a program ends
  kLost,       // what it published then is not in the recording
};
inline constexpr std::size_t kDoubtCount = 6;
[[nodiscard]] constexpr const char* to_string(Doubt doubt) noexcept {
  switch (doubt) {
    case Doubt::kBeginning: return "begun before the recording";
    case Doubt::kGap: return "something it saw is not in the recording";
    case Doubt::kTorn: return "something it saw was written over meanwhile";
    case Doubt::kForeign: return "its inputs are of another build";
    case Doubt::kNoStep: return "published outside of its recorded steps";
    case Doubt::kLost: return "what it published is not in the recording";
  }
  return "";
}

struct TaskVerdict {
  static constexpr std::size_t kMostTold = 1000;

  TaskId task = TaskId::kWorld;
  std::uint64_t steps = 0;
  std::uint64_t judged = 0;     // decisions: publications
  std::uint64_t differing = 0;  // of them
  std::array<std::uint64_t, kDoubtCount> not_judged{};
  std::optional<Time> judged_from;
  std::vector<Difference> differences;  // the first kMostTold

  [[nodiscard]] std::uint64_t not_judged_in_all() const noexcept {
    std::uint64_t sum = 0;
    for (const std::uint64_t count : not_judged) {
      sum += count;
    }
    return sum;
  }
};

}  // namespace lodesman::cli
