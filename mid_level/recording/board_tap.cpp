// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/board_tap.h"

#include "mid_level/recording/raw_codec.h"

namespace lodesman {

class BoardTap::Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  virtual ~Follower() = default;
  virtual void poll(PublicationSink& sink) noexcept = 0;
};

template <class T>
class BoardTap::ChannelFollower final : public Follower {
 public:
  template <std::size_t kDepth>
  ChannelFollower(std::uint32_t index, const Channel<T, kDepth>& channel, Past past)
      : index_{index},
        depth_{kDepth},
        reader_{channel},
        from_the_first_{past == Past::kGap || reader_.newest_sequence() == 0} {}

  void poll(PublicationSink& sink) noexcept override {
    // What is announced by now and is not had by this look will never be had.
    const std::uint64_t newest = reader_.newest_sequence();
    // No more than the ring holds, whatever its writer does meanwhile.
    for (std::size_t i = 0; i < depth_; ++i) {
      const Stamped<T>* published = reader_.next();
      if (published == nullptr) {
        break;
      }
      note_gap_before(published->sequence, sink);
      seen_ = published->sequence;
      hand_on(*published, sink);
    }
    if (newest > seen_) {
      note_gap_before(newest + 1, sink);
      seen_ = newest;
    }
  }

 private:
  void note_gap_before(std::uint64_t sequence, PublicationSink& sink) const noexcept {
    if (sequence > seen_ + 1 && (seen_ != 0 || from_the_first_)) {
      sink.note({index_, GapCause::kOverwritten, seen_ + 1, sequence - 1});
    }
  }

  void hand_on(const Stamped<T>& published, PublicationSink& sink) const noexcept {
    const std::size_t bytes = used_bytes(published.value);
    const Publication publication{index_, static_cast<std::uint32_t>(bytes), published.stamp,
                                  published.sequence};
    if (const auto room = sink.room_for(publication); !room.empty()) {
      encode_raw(published.value, room);
      sink.take(publication);
    }
  }

  std::uint32_t index_;
  std::size_t depth_;
  Reader<T> reader_;
  bool from_the_first_;
  std::uint64_t seen_ = 0;  // handed on, or told as a gap
};

BoardTap::BoardTap(const Blackboard& board, Past past) {
  for_each_channel(board, [this, past]<class T, std::size_t kDepth>(
                              const ChannelInfo& /*info*/, const Channel<T, kDepth>& channel) {
    channels_.push_back(std::make_unique<ChannelFollower<T>>(
        static_cast<std::uint32_t>(channels_.size()), channel, past));
  });
}

BoardTap::BoardTap(BoardTap&&) noexcept = default;
BoardTap& BoardTap::operator=(BoardTap&&) noexcept = default;
BoardTap::~BoardTap() = default;

void BoardTap::poll(PublicationSink& sink) noexcept {
  for (const auto& channel : channels_) {
    channel->poll(sink);
  }
}

std::vector<RawChannel> raw_channels() {
  std::vector<RawChannel> channels;
  const auto board = std::make_unique<Blackboard>();
  for_each_channel(*board, [&]<class C>(const ChannelInfo& info, const C& /*channel*/) {
    channels.push_back({info.name, raw_layout<typename C::Value>()});
  });
  return channels;
}

}  // namespace lodesman
