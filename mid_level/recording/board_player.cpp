// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/board_player.h"

#include <algorithm>

#include "mid_level/recording/raw_codec.h"
#include "mid_level/recording/recording.h"

namespace lodesman {

class BoardPlayer::Publisher {
 public:
  Publisher() = default;
  Publisher(const Publisher&) = delete;
  Publisher& operator=(const Publisher&) = delete;
  virtual ~Publisher() = default;
  // False where the bytes are no sane value.
  [[nodiscard]] virtual bool publish(std::span<const std::byte> raw, Time stamp) = 0;
};

template <class T>
class BoardPlayer::PublisherOf final : public Publisher {
 public:
  explicit PublisherOf(Writer<T> writer) : writer_{std::move(writer)} {}
  [[nodiscard]] bool publish(std::span<const std::byte> raw, Time stamp) override {
    if (!decode_raw(raw, *value_)) {
      return false;
    }
    writer_.publish(*value_, stamp);
    return true;
  }

 private:
  Writer<T> writer_;
  std::unique_ptr<T> value_ = std::make_unique<T>();
};

BoardPlayer::BoardPlayer(Blackboard& board) : known_{raw_channels()} {
  for_each_channel(board, [&](const ChannelInfo& info, auto& channel) {
    using T = typename std::remove_reference_t<decltype(channel)>::Value;
    publishers_.push_back(
        std::make_unique<PublisherOf<T>>(Writer<T>{channel, info.writer, info.name}));
  });
}

BoardPlayer::~BoardPlayer() = default;

void BoardPlayer::take(const McapReader& reader, McapItem item) {
  if (item == McapItem::kChannel) {
    meet(reader);
  }
  if (item != McapItem::kMessage) {
    return;
  }
  const McapMessage& message = reader.message();
  const auto found = by_id_.find(message.channel);
  if (found == by_id_.end()) {
    return;
  }
  const Time stamp{Duration{static_cast<Duration::rep>(message.publish_time_ns)}};
  insane_ += found->second->publish(message.data, stamp) ? 0U : 1U;
}

void BoardPlayer::meet(const McapReader& reader) {
  const McapChannel& met = reader.channel();
  if (met.message_encoding != kRawEncoding) {
    return;
  }
  const McapSchema* schema = reader.schema_by_id(met.schema);
  for (std::size_t i = 0; i < known_.size(); ++i) {
    if (met.topic == kRawTopics + known_[i].name && schema != nullptr &&
        schema->data == known_[i].layout) {
      by_id_[met.id] = publishers_[i].get();
      return;
    }
  }
  const auto place = std::lower_bound(left_out_.begin(), left_out_.end(), met.topic);
  if (place == left_out_.end() || *place != met.topic) {
    left_out_.insert(place, met.topic);
  }
}

}  // namespace lodesman
