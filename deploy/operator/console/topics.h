// SPDX-License-Identifier: Apache-2.0
// The topics of the console and the newest message of each part of them, bounded in number. What is
// kept here goes at once to who begins to listen, and what waits for a client is kept in the same
// way: newest wins, whole messages are dropped. One thread.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mid_level/recording/viewer_sink.h"

namespace lodesman::console {

struct Message {
  Time stamp{};
  std::string json;
};
// Shared by all who have still to take it (ADR 0048).
using MessagePtr = std::shared_ptr<const Message>;

// The newest message of each of the last parts that spoke, in the order in which they did.
class NewestParts {
 public:
  static constexpr std::size_t kMaxParts = 64;

  void put(const std::string& part, MessagePtr message);
  // The oldest; nullptr where there is none.
  [[nodiscard]] MessagePtr take();
  [[nodiscard]] bool empty() const noexcept { return parts_.empty(); }
  void clear() noexcept { parts_.clear(); }
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Part& part : parts_) {
      visit(part.name, part.message);
    }
  }

 private:
  struct Part {
    std::string name;
    MessagePtr message;
  };
  std::deque<Part> parts_;
};

class TopicTable final : public ViewerSink {
 public:
  struct Topic {
    std::string name;
    std::string schema_name;
    std::string schema;
    NewestParts kept;
    unsigned listeners = 0;
  };
  using Published =
      std::function<void(std::uint16_t topic, const std::string& part, const MessagePtr& message)>;

  // Is called for each message, after it was kept.
  void set_published(Published published) { published_ = std::move(published); }

  [[nodiscard]] std::uint16_t add_topic(const std::string& name,
                                        const viewer::Shape& shape) override;
  void publish(std::uint16_t topic, const std::string& part, Time stamp,
               const std::string& json) override;
  // What was kept is of a boat that is gone.
  void forget();

  [[nodiscard]] std::size_t size() const noexcept { return topics_.size(); }
  [[nodiscard]] Topic& operator[](std::uint16_t topic) { return topics_[topic]; }
  [[nodiscard]] const Topic& operator[](std::uint16_t topic) const { return topics_[topic]; }

 private:
  std::vector<Topic> topics_;
  Published published_;
};

}  // namespace lodesman::console
