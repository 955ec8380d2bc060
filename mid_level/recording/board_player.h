// SPDX-License-Identifier: Apache-2.0
// Publishes a recording once more, on a blackboard of its own: each value with the stamp that it
// had, in the order of the file. Its numbers count from 1, whatever they were: what was missed is
// no gap here. Channels that another build lays out otherwise are left out, and named. One thread;
// it allocates.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mid_level/blackboard/blackboard.h"
#include "mid_level/recording/board_tap.h"
#include "mid_level/recording/mcap_reader.h"

namespace lodesman {

class BoardPlayer {
 public:
  // Becomes the writer of all of its channels. Throws StartupError where one has a writer.
  explicit BoardPlayer(Blackboard& board);
  BoardPlayer(const BoardPlayer&) = delete;
  BoardPlayer& operator=(const BoardPlayer&) = delete;
  ~BoardPlayer();

  // To be called before each file: its channels have ids of their own.
  void begin_file() { by_id_.clear(); }
  // What the reader has just come to: a channel is met, a message of one is published.
  void take(const McapReader& reader, McapItem item);

  // Topics that were met and could not be read, sorted.
  [[nodiscard]] const std::vector<std::string>& left_out() const noexcept { return left_out_; }
  // Messages of known channels that were no sane values.
  [[nodiscard]] std::uint64_t insane() const noexcept { return insane_; }

 private:
  class Publisher;
  template <class T>
  class PublisherOf;

  void meet(const McapReader& reader);

  std::vector<RawChannel> known_;
  std::vector<std::unique_ptr<Publisher>> publishers_;  // as for_each_channel() has them
  std::map<std::uint16_t, Publisher*> by_id_;
  std::vector<std::string> left_out_;
  std::uint64_t insane_ = 0;
};

}  // namespace lodesman
