// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/fed_board.h"

#include <algorithm>
#include <type_traits>

#include "mid_level/recording/raw_codec.h"

namespace lodesman::cli {

class FedBoard::Feeder {
 public:
  Feeder() = default;
  Feeder(const Feeder&) = delete;
  Feeder& operator=(const Feeder&) = delete;
  virtual ~Feeder() = default;
  // False where it is no sane value.
  virtual bool feed(const Recorded& recorded) = 0;
};

template <class T>
class FedBoard::FeederOf final : public Feeder {
 public:
  FeederOf(Writer<T> writer, const TunablesChange& change)
      : writer_{std::move(writer)}, change_{change} {}

  bool feed(const Recorded& recorded) override {
    if (!decode_raw(recorded.raw, *value_) || recorded.sequence >= kLastSequence) {
      return false;
    }
    if constexpr (std::is_same_v<T, Tunables>) {
      for (const auto& [member, value] : change_) {
        (*value_).*member = value;
      }
    }
    writer_.go_on_after(recorded.sequence - 1);
    writer_.publish(*value_, recorded.stamp);
    return true;
  }

 private:
  Writer<T> writer_;
  const TunablesChange& change_;
  std::unique_ptr<T> value_ = std::make_unique<T>();
};

FedBoard::FedBoard(const TunablesChange& change)
    : change_{change}, board_{std::make_unique<Blackboard>()} {
  for_each_channel(*board_, [this](const ChannelInfo& /*info*/, const auto& /*channel*/) {
    feeders_.emplace_back();
    fed_.push_back(0);
  });
}

FedBoard::~FedBoard() = default;

void FedBoard::release(std::uint64_t channel) { feeders_[channel].reset(); }

FedBoard::Feeder& FedBoard::feeder(std::uint64_t channel) {
  std::uint64_t place = 0;
  for_each_channel(*board_, [&](const ChannelInfo& info, auto& each) {
    using T = typename std::remove_reference_t<decltype(each)>::Value;
    if (place++ == channel && !feeders_[channel]) {
      feeders_[channel] =
          std::make_unique<FeederOf<T>>(Writer<T>{each, info.writer, info.name}, change_);
    }
  });
  return *feeders_[channel];
}

bool FedBoard::feed_up_to(std::uint64_t channel, std::uint64_t sequence, const ChannelLog& log) {
  std::uint64_t& fed = fed_[channel];
  if (fed >= sequence) {
    return true;
  }
  // What the ring has lost by then is nobody's input.
  fed = std::max(fed, sequence > log.depth() ? sequence - log.depth() : 0);
  bool all = true;
  const Recorded* next = log.after(fed);
  for (; next != nullptr && next->sequence <= sequence; next = log.after(fed)) {
    all &= next->sequence == fed + 1;
    all &= feeder(channel).feed(*next);
    fed = next->sequence;
  }
  return all && fed == sequence;
}

}  // namespace lodesman::cli
