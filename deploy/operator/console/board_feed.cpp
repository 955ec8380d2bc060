// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/board_feed.h"

#include <exception>

#include "mid_level/base/startup_error.h"

namespace lodesman::console {

BoardFeed::BoardFeed(std::string segment, TopicTable& topics)
    : segment_{std::move(segment)}, topics_{topics}, viewers_{topics} {
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    const auto topic = static_cast<std::uint16_t>(i);
    if (topics_[topic].name == "/sonar") {
      sonar_topic_ = topic;
    }
  }
  const auto channels = raw_channels();
  for (std::uint32_t i = 0; i < channels.size(); ++i) {
    if (channels[i].name == "sonar_ping") {
      ping_channel_ = i;
    }
  }
}

void BoardFeed::attach() {
  try {
    board_.emplace(SharedBlackboard::observe(segment_, Duration::zero()));
    readers_.emplace(**board_);
    tap_.emplace(**board_);
    absence_.clear();
  } catch (const std::exception& error) {  // none yet, another user's, another version's
    tap_.reset();
    readers_.reset();
    board_.reset();
    absence_ = error.what();
  }
}

bool BoardFeed::look(Time now) {
  bool another = false;
  if (now - looked_for_ >= kAttachPeriod || looked_for_ == Time{}) {
    looked_for_ = now;
    if (board_ && board_->is_superseded()) {
      tap_.reset();
      readers_.reset();
      board_.reset();
      picture_ = {};
      another = true;
    }
    if (!board_) {
      attach();
      another = another || board_.has_value();
    }
    low_alive_ = board_ && board_->alive(Role::kLow);
    high_alive_ = board_ && board_->alive(Role::kHigh);
  }
  if (another) {
    topics_.forget();
    viewers_.begin_anew();
  }
  if (board_) {
    tap_->poll(*this);
    picture_ = readers_->look(now);
  }
  picture_.now = now;
  picture_.low_alive = low_alive_;
  picture_.high_alive = high_alive_;
  return another;
}

// A picture of a ping is made where somebody looks at it.
std::span<std::byte> BoardFeed::room_for(const Publication& publication) noexcept {
  if (publication.channel == ping_channel_ && topics_[sonar_topic_].listeners == 0) {
    return {};
  }
  room_.resize(publication.bytes);
  return room_;
}

void BoardFeed::take(const Publication& publication) noexcept { viewers_.take(publication, room_); }

void BoardFeed::note(const Gap& /*gap*/) noexcept {}

}  // namespace lodesman::console
