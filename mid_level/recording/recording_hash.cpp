// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/recording_hash.h"

#include <xxhash.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <vector>

namespace lodesman {
namespace {

struct StateDeleter {
  void operator()(XXH3_state_t* state) const noexcept { XXH3_freeState(state); }
};

// Gathers small fields, because each call into the hash has a price.
class HashSink {
 public:
  static constexpr bool kSkipMeasured = true;

  explicit HashSink(XXH3_state_t* state) noexcept : state_{state} {}

  template <class T>
  void operator()(const char* /*name*/, const T& value) noexcept {
    add(&value, sizeof(value));
  }
  void operator()(const char* /*name*/, const std::uint8_t* data, std::size_t count) noexcept {
    flush();
    XXH3_128bits_update(state_, data, count);
  }
  void flush() noexcept {
    XXH3_128bits_update(state_, buffer_.data(), used_);
    used_ = 0;
  }

 private:
  void add(const void* value, std::size_t bytes) noexcept {
    if (used_ + bytes > buffer_.size()) {
      flush();
    }
    std::memcpy(buffer_.data() + used_, value, bytes);
    used_ += bytes;
  }

  XXH3_state_t* state_;
  std::array<std::byte, 4096> buffer_{};
  std::size_t used_ = 0;
};

}  // namespace

namespace {

class Follower {
 public:
  Follower() = default;
  Follower(const Follower&) = delete;
  Follower& operator=(const Follower&) = delete;
  virtual ~Follower() = default;
  virtual void update(HashSink& sink) noexcept = 0;
};

template <class T>
class ChannelFollower final : public Follower {
 public:
  template <std::size_t kDepth>
  ChannelFollower(std::uint64_t index, const Channel<T, kDepth>& channel)
      : index_{index}, reader_{channel} {}

  void update(HashSink& sink) noexcept override {
    while (const auto* published = reader_.next()) {
      sink("channel", index_);
      sink("stamp", published->stamp.time_since_epoch().count());
      sink("sequence", published->sequence);
      visit_message(sink, published->value);
    }
  }

 private:
  std::uint64_t index_;
  Reader<T> reader_;
};

}  // namespace

struct RecordingHash::Impl {
  std::unique_ptr<XXH3_state_t, StateDeleter> state{XXH3_createState()};
  HashSink sink{state.get()};
  std::vector<std::unique_ptr<Follower>> channels;
};

RecordingHash::RecordingHash(const Blackboard& board) : impl_{std::make_unique<Impl>()} {
  XXH3_128bits_reset(impl_->state.get());
  for_each_channel(board, [this]<class T, std::size_t kDepth>(const ChannelInfo& /*info*/,
                                                              const Channel<T, kDepth>& channel) {
    impl_->channels.push_back(
        std::make_unique<ChannelFollower<T>>(impl_->channels.size(), channel));
  });
}

RecordingHash::~RecordingHash() = default;

void RecordingHash::update() noexcept {
  for (const auto& channel : impl_->channels) {
    channel->update(impl_->sink);
  }
}

std::string RecordingHash::digest() const {
  impl_->sink.flush();
  const XXH128_hash_t hash = XXH3_128bits_digest(impl_->state.get());
  std::array<char, 33> text{};
  std::snprintf(text.data(), text.size(), "%016llx%016llx",
                static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text.data();
}

}  // namespace lodesman
