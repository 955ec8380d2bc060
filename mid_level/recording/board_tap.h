// SPDX-License-Identifier: Apache-2.0
// Follows every channel of a blackboard and hands on each publication once, in its raw bytes, and
// each number that it could not have as a gap, told by the same look that missed it. poll()
// allocates nothing, waits for nothing and writes nothing to the blackboard; one thread.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mid_level/blackboard/blackboard.h"

namespace lodesman {

// Which publication it is: the channel by its place in for_each_channel().
struct Publication {
  std::uint32_t channel = 0;
  std::uint32_t bytes = 0;
  Time stamp{};
  std::uint64_t sequence = 0;
};

enum class GapCause : std::uint8_t {
  kOverwritten,  // written over before it was looked at, not sane, or its writer died over it
  kQueueFull,    // the disk did not keep up
  kNotWritten,   // it could not be written, or there was no room
};
[[nodiscard]] constexpr auto enumerators(GapCause) noexcept {
  return enumerators_to<GapCause::kNotWritten>("overwritten", "queue_full", "not_written");
}

// Publications `first` to `last` of a channel are not in the recording.
struct Gap {
  std::uint32_t channel = 0;
  GapCause cause = GapCause::kOverwritten;
  std::uint64_t first = 0;
  std::uint64_t last = 0;
};

// Takes what a tap hands on. All noexcept, for the tap's thread.
class PublicationSink {
 public:
  PublicationSink() = default;
  PublicationSink(const PublicationSink&) = delete;
  PublicationSink& operator=(const PublicationSink&) = delete;
  virtual ~PublicationSink() = default;
  // Where its `bytes` are to go, or nothing where there is no room; then take() or, for nothing, a
  // gap that the sink remembers by itself.
  [[nodiscard]] virtual std::span<std::byte> room_for(const Publication& publication) noexcept = 0;
  virtual void take(const Publication& publication) noexcept = 0;
  virtual void note(const Gap& gap) noexcept = 0;
};

class BoardTap {
 public:
  // What was published, and is in no ring any more, before the tap came.
  enum class Past : std::uint8_t { kNoGap, kGap };

  // `board` must outlive it. What its rings still hold is handed on too.
  explicit BoardTap(const Blackboard& board, Past past = Past::kNoGap);
  BoardTap(const BoardTap&) = delete;
  BoardTap& operator=(const BoardTap&) = delete;
  BoardTap(BoardTap&&) noexcept;
  BoardTap& operator=(BoardTap&&) noexcept;
  ~BoardTap();

  void poll(PublicationSink& sink) noexcept;

 private:
  class Follower;
  template <class T>
  class ChannelFollower;
  std::vector<std::unique_ptr<Follower>> channels_;
};

// What a recording says of each channel, in the order of for_each_channel().
struct RawChannel {
  std::string name;
  std::string layout;
};
[[nodiscard]] std::vector<RawChannel> raw_channels();

}  // namespace lodesman
