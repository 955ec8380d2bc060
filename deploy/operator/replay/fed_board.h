// SPDX-License-Identifier: Apache-2.0
// A blackboard on which one task is stepped again: others' channels hold what the recording has of
// them, with the numbers that they had. One thread.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "deploy/operator/replay/publication_log.h"
#include "mid_level/blackboard/blackboard.h"

namespace lodesman::cli {

// What of the tunables is to be otherwise than recorded.
using TunablesChange = std::vector<std::pair<double Tunables::*, double>>;

class FedBoard {
 public:
  // `change` must outlive it.
  explicit FedBoard(const TunablesChange& change);
  FedBoard(const FedBoard&) = delete;
  FedBoard& operator=(const FedBoard&) = delete;
  ~FedBoard();

  [[nodiscard]] Blackboard& operator*() noexcept { return *board_; }

  // Up to and with that number, as far as the log has it. False where something is not there that
  // the ring would hold now.
  bool feed_up_to(std::uint64_t channel, std::uint64_t sequence, const ChannelLog& log);
  // The channel can have another writer.
  void release(std::uint64_t channel);

 private:
  class Feeder;
  template <class T>
  class FeederOf;

  [[nodiscard]] Feeder& feeder(std::uint64_t channel);

  const TunablesChange& change_;
  std::unique_ptr<Blackboard> board_;
  std::vector<std::unique_ptr<Feeder>> feeders_;
  std::vector<std::uint64_t> fed_;  // by channel: the last number
};

}  // namespace lodesman::cli
