// SPDX-License-Identifier: Apache-2.0
// Records a blackboard in the thread that runs the boat itself, in lock-step: there is no queue
// between, and nothing can be missed. One thread.
#pragma once

#include <vector>

#include "mid_level/recording/file_series.h"

namespace lodesman::cli {

class DirectRecording final : private PublicationSink {
 public:
  // Both must outlive it.
  DirectRecording(const Blackboard& board, FileSeries& series) : tap_{board}, series_{series} {}

  // Takes in what was published since the last call; to be called after every step.
  void update(Time now) noexcept;

 private:
  [[nodiscard]] std::span<std::byte> room_for(const Publication& publication) noexcept override;
  void take(const Publication& publication) noexcept override;
  void note(const Gap& gap) noexcept override;

  BoardTap tap_;
  FileSeries& series_;
  std::vector<std::byte> room_;
  Time now_{};
};

}  // namespace lodesman::cli
