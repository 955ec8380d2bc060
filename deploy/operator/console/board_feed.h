// SPDX-License-Identifier: Apache-2.0
// The boat's blackboard as the console follows it: mapped read-only where there is one, looked for
// once a second where there is none, given up for another that a low level has made. One thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/console/board_picture.h"
#include "deploy/operator/console/topics.h"
#include "mid_level/blackboard/segment.h"
#include "mid_level/recording/board_tap.h"
#include "mid_level/recording/viewer_channels.h"

namespace lodesman::console {

class BoardFeed final : private PublicationSink {
 public:
  static constexpr Duration kAttachPeriod = std::chrono::seconds{1};

  // The viewers' topics are added to `topics`, which must outlive it.
  BoardFeed(std::string segment, TopicTable& topics);

  // Looks, and publishes what the viewers' topics have of it. What has come is in picture(). True
  // where this is another boat than at the last look, or none any more.
  bool look(Time now);
  [[nodiscard]] const BoardPicture& picture() const noexcept { return picture_; }
  [[nodiscard]] bool is_attached() const noexcept { return board_.has_value(); }
  // Why there is none; empty where there is.
  [[nodiscard]] const std::string& absence() const noexcept { return absence_; }

 private:
  [[nodiscard]] std::span<std::byte> room_for(const Publication& publication) noexcept override;
  void take(const Publication& publication) noexcept override;
  void note(const Gap& gap) noexcept override;
  void attach();

  std::string segment_;
  TopicTable& topics_;
  ViewerChannels viewers_;
  std::uint16_t sonar_topic_ = 0;
  std::uint32_t ping_channel_ = 0;
  std::optional<SharedBlackboard> board_;
  std::optional<BoardReaders> readers_;
  std::optional<BoardTap> tap_;
  std::vector<std::byte> room_;
  BoardPicture picture_;
  std::string absence_ = "not looked for yet";
  Time looked_for_{};
  bool low_alive_ = false;
  bool high_alive_ = false;
};

}  // namespace lodesman::console
