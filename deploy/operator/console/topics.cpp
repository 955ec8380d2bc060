// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/topics.h"

#include <algorithm>

namespace lodesman::console {

void NewestParts::put(const std::string& part, MessagePtr message) {
  const auto same = std::find_if(parts_.begin(), parts_.end(),
                                 [&](const Part& kept) { return kept.name == part; });
  if (same != parts_.end()) {
    parts_.erase(same);
  } else if (parts_.size() >= kMaxParts) {
    parts_.pop_front();
  }
  parts_.push_back({part, std::move(message)});
}

MessagePtr NewestParts::take() {
  if (parts_.empty()) {
    return nullptr;
  }
  MessagePtr message = std::move(parts_.front().message);
  parts_.pop_front();
  return message;
}

std::uint16_t TopicTable::add_topic(const std::string& name, const viewer::Shape& shape) {
  topics_.push_back({name, shape.name, shape.schema.dump(), {}, 0});
  return static_cast<std::uint16_t>(topics_.size() - 1);
}

void TopicTable::publish(std::uint16_t topic, const std::string& part, Time stamp,
                         const std::string& json) {
  const auto message = std::make_shared<const Message>(Message{stamp, json});
  topics_[topic].kept.put(part, message);
  if (published_) {
    published_(topic, part, message);
  }
}

void TopicTable::forget() {
  for (Topic& topic : topics_) {
    topic.kept.clear();
  }
}

}  // namespace lodesman::console
