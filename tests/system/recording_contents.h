// SPDX-License-Identifier: Apache-2.0
// What stands in a recording: its topics, and which numbers of each channel it tells, be it as
// messages or as gaps.
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/recording.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

struct Topic {
  std::uint64_t count = 0;
  std::uint64_t last = 0;
};

// Numbers of one channel, from the first on.
struct Told {
  std::uint64_t first = 0;  // 0: none
  std::uint64_t last = 0;
  bool unbroken = true;
};

// First and last number of a message or a gap.
using Numbers = std::vector<std::pair<std::uint64_t, std::uint64_t>>;

struct Contents {
  std::map<std::string, Topic> topics;
  std::vector<nlohmann::json> gaps;
  std::map<std::string, Numbers> numbers;  // by channel
  std::map<std::string, std::string> about;
  std::map<std::string, std::string> attachments;
  std::uint64_t chunks = 0;
  std::uint64_t damaged = 0;
  McapEnding ending = McapEnding::kOpen;

  [[nodiscard]] std::uint64_t count(const std::string& topic) const {
    const auto found = topics.find(topic);
    return found == topics.end() ? 0 : found->second.count;
  }
  [[nodiscard]] Numbers numbers_of(const std::string& channel) const {
    const auto found = numbers.find(channel);
    return found == numbers.end() ? Numbers{} : found->second;
  }
};

[[nodiscard]] inline Told told_by(Numbers numbers) {
  std::sort(numbers.begin(), numbers.end());
  Told told;
  for (const auto& [first, last] : numbers) {
    told.unbroken = told.unbroken && (told.first == 0 || first <= told.last + 1);
    told.first = told.first == 0 ? first : told.first;
    told.last = std::max(told.last, last);
  }
  return told;
}

inline void take_message(Contents& contents, const McapReader& reader) {
  const McapMessage& message = reader.message();
  const std::string& name = reader.channel_by_id(message.channel)->topic;
  Topic& topic = contents.topics[name];
  topic.last = message.sequence;
  ++topic.count;
  if (name == kGapsTopic) {
    const auto gap = nlohmann::json::parse(
        std::string{reinterpret_cast<const char*>(message.data.data()), message.data.size()});
    contents.numbers[gap["channel"]].emplace_back(gap["first"], gap["last"]);
    contents.gaps.push_back(gap);
  } else if (name.starts_with(kRawTopics)) {
    contents.numbers[name.substr(std::string{kRawTopics}.size())].emplace_back(message.sequence,
                                                                               message.sequence);
  }
}

[[nodiscard]] inline Contents contents_of(const std::filesystem::path& file) {
  McapFileSource source{file};
  McapReader reader{source};
  Contents contents;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMessage) {
      take_message(contents, reader);
    } else if (item == McapItem::kMetadata) {
      contents.about.insert(reader.metadata().values.begin(), reader.metadata().values.end());
    } else if (item == McapItem::kAttachment) {
      contents.attachments[reader.attachment().name] = reader.attachment().data;
    }
  }
  contents.chunks = reader.chunk_count();
  contents.damaged = reader.damaged();
  contents.ending = reader.ending();
  return contents;
}

// At least so many channels a boat that is under way publishes on.
constexpr std::size_t kChannelsUnderWay = 16;

// Each number of each channel is there or told as a gap, from the first that is. How many gaps
// there are is the machine's affair in real time.
inline void check_told(const Contents& contents) {
  CHECK(contents.damaged == 0);
  CHECK(contents.numbers.size() >= kChannelsUnderWay);
  for (const auto& [channel, numbers] : contents.numbers) {
    const Told told = told_by(numbers);
    INFO(channel << ": from " << told.first << " to " << told.last);
    CHECK(told.unbroken);
  }
}

}  // namespace lodesman::testing
