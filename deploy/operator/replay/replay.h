// SPDX-License-Identifier: Apache-2.0
// A recording's decisions made again, each task by itself from what the recording has of its inputs
// (ADR 0038). One thread; StartupError says what cannot be read.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "deploy/operator/replay/verdict.h"

namespace lodesman::cli {

struct ReplayRequest {
  std::vector<std::filesystem::path> files;  // one recording, in the order of its parts; not empty
  std::vector<std::string> sets;             // SECTION.KEY=VALUE, over the recorded configuration
  std::function<bool()> interrupted;
  std::function<void(Duration)> show;  // how much of the boat's time is done; may be empty
};

struct ReplayResult {
  std::map<std::string, std::string> about;  // what the recording says of itself
  std::vector<TaskVerdict> tasks;
  // What is not in it, a line each: files that were cut off, gaps, channels of another build.
  std::vector<std::string> lacks;
  Duration span{};  // of the boat's time, from the first step to the last
  double took_s = 0.0;

  [[nodiscard]] std::uint64_t judged() const noexcept;
  [[nodiscard]] std::uint64_t differing() const noexcept;
  [[nodiscard]] std::uint64_t not_judged() const noexcept;
  // The earliest; nullptr where nothing differs.
  [[nodiscard]] const Difference* first() const noexcept;
};

[[nodiscard]] ReplayResult replay(const ReplayRequest& request);

}  // namespace lodesman::cli
