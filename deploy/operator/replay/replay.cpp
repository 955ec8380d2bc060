// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/replay/replay.h"

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "deploy/operator/replay/judged_task.h"
#include "deploy/operator/replay/recorded_setup.h"
#include "mid_level/base/stopwatch.h"
#include "mid_level/recording/board_tap.h"
#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/recording.h"

namespace lodesman::cli {
namespace {
namespace fs = std::filesystem;

// Channels do not stand in the file in one order of time: a recorder looks at one after the other.
constexpr Duration kSettled = std::chrono::seconds{3};
constexpr Duration kAdvanceEvery = std::chrono::milliseconds{500};
// However long a stretch of time they are of, no more waits for that.
constexpr std::size_t kMostWaiting_bytes = std::size_t{1} << 28U;

// Said again at the beginning of each later part.
constexpr std::array<std::string_view, 4> kSaidAgain{"world_origin", "mission_definition",
                                                     "tunables", "box_proof"};

[[nodiscard]] bool is_said_again(std::string_view topic) {
  return std::any_of(kSaidAgain.begin(), kSaidAgain.end(), [&](std::string_view channel) {
    return topic == std::string{kRawTopics} + std::string{channel};
  });
}

// Publications that the recording names as missing.
[[nodiscard]] std::uint64_t gap_of(const McapMessage& message) {
  const auto* text = reinterpret_cast<const char*>(message.data.data());
  const auto json = nlohmann::json::parse(text, text + message.data.size(), nullptr, false);
  const auto count = json.is_object() ? json.find("count") : json.end();
  return count != json.end() && count->is_number_unsigned() ? count->get<std::uint64_t>() : 0;
}

// The tasks of one segment: all numbers count on.
class Segment {
 public:
  Segment(const RecordedSetup& setup, const std::vector<TaskVerdict>& before) : setup_{setup} {
    for (std::size_t i = 0; i < kReplayedCount; ++i) {
      tasks_.push_back(std::make_unique<JudgedTask>(i, setup_.options, setup_.change, log_));
      tasks_.back()->go_on_from(before[i]);
    }
  }
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;
  ~Segment() = default;

  [[nodiscard]] PublicationLog& log() noexcept { return log_; }

  void came_to(Time stamp, const std::vector<std::uint64_t>& places) {
    newest_ = std::max(newest_, stamp);
    const bool is_due = newest_ - kSettled >= advanced_ + kAdvanceEvery;
    if (is_due || waiting_bytes() > kMostWaiting_bytes) {
      advance(is_due ? newest_ - kSettled : newest_, places);
    }
  }
  void finish(const std::vector<std::uint64_t>& places) {
    advance(Time::max(), places);
    for (const auto& task : tasks_) {
      task->finish();
    }
  }

  [[nodiscard]] std::vector<TaskVerdict> verdicts() const {
    std::vector<TaskVerdict> verdicts;
    for (const auto& task : tasks_) {
      verdicts.push_back(task->verdict());
    }
    return verdicts;
  }
  // From the first step to the last.
  [[nodiscard]] Duration span() const {
    std::optional<Time> first;
    Time last{};
    for (const auto& task : tasks_) {
      if (const auto began = task->first_step()) {
        first = std::min(first.value_or(*began), *began);
        last = std::max(last, task->last_step());
      }
    }
    return first ? last - *first : Duration{};
  }

 private:
  [[nodiscard]] std::size_t waiting_bytes() const noexcept {
    std::size_t sum = 0;
    for (const ChannelLog& channel : log_) {
      sum += channel.bytes();
    }
    return sum;
  }
  void advance(Time until, const std::vector<std::uint64_t>& places) {
    for (const auto& task : tasks_) {
      task->advance(until, places);
    }
    advanced_ = until;
    for (ChannelLog& channel : log_) {
      channel.forget_before(until - kSettled);
    }
  }

  const RecordedSetup& setup_;
  PublicationLog log_ = empty_log();
  std::vector<std::unique_ptr<JudgedTask>> tasks_;
  Time newest_{};
  Time advanced_{};
};

class Replaying {
 public:
  Replaying(const ReplayRequest& request, const RecordedSetup& setup)
      : request_{request}, setup_{setup}, known_{raw_channels()} {
    std::vector<TaskVerdict> none(kReplayedCount);
    for (std::size_t i = 0; i < kReplayedCount; ++i) {
      none[i].task = kStepInputsInfo[i].task;
    }
    segment_.emplace(setup_, none);
  }

  void read(const fs::path& file) {
    McapFileSource source{file};
    McapReader reader{source};
    by_id_.clear();
    places_.clear();
    is_checked_ = is_first_file_;
    is_first_file_ = false;
    for (McapItem item = reader.next(); item != McapItem::kEnd && !request_.interrupted();
         item = reader.next()) {
      if (item == McapItem::kChannel) {
        meet(reader);
      } else if (item == McapItem::kMessage) {
        take(reader);
      }
    }
    if (reader.ending() != McapEnding::kWhole && !request_.interrupted()) {
      lacks_.push_back(file.string() + ": " + reader.reason());
    }
    if (reader.damaged() > 0) {
      lacks_.push_back(file.string() + ": " + std::to_string(reader.damaged()) +
                       " records or chunks failed their checks");
    }
  }

  [[nodiscard]] ReplayResult finish() {
    segment_->finish(places_);
    ReplayResult result{setup_.about, segment_->verdicts(), lacks_, span_ + segment_->span()};
    if (gaps_ > 0) {
      result.lacks.push_back(std::to_string(gaps_) + " publications were missed by the recorder");
    }
    if (out_of_order_ > 0) {
      result.lacks.push_back(std::to_string(out_of_order_) +
                             " publications are too large, or of numbers that do not go on");
    }
    if (of_no_clock_ > 0) {
      result.lacks.push_back(std::to_string(of_no_clock_) + " publications are of no clock");
    }
    for (const std::string& topic : left_out_) {
      result.lacks.push_back(topic + " is laid out by another build, and is left out");
    }
    return result;
  }

 private:
  // Raw channels are in a file in the order of the blackboard that was recorded.
  void meet(const McapReader& reader) {
    const McapChannel& met = reader.channel();
    if (met.message_encoding != kRawEncoding) {
      return;
    }
    const McapSchema* schema = reader.schema_by_id(met.schema);
    std::uint64_t place = 0;
    while (place < known_.size() && met.topic != kRawTopics + known_[place].name) {
      ++place;
    }
    const bool fits =
        place < known_.size() && schema != nullptr && schema->data == known_[place].layout;
    places_.push_back(fits ? place : known_.size());
    if (fits) {
      by_id_[met.id] = place;
      return;
    }
    if (place < known_.size()) {
      segment_->log()[place].leave_out();
    }
    if (std::find(left_out_.begin(), left_out_.end(), met.topic) == left_out_.end()) {
      left_out_.push_back(met.topic);
    }
  }

  void take(const McapReader& reader) {
    const McapMessage& message = reader.message();
    const auto found = by_id_.find(message.channel);
    if (found == by_id_.end()) {
      const McapChannel* channel = reader.channel_by_id(message.channel);
      gaps_ += channel != nullptr && channel->topic == kGapsTopic ? gap_of(message) : 0;
      return;
    }
    const Time stamp{Duration{static_cast<Duration::rep>(message.publish_time_ns)}};
    if (!sane(stamp)) {
      ++of_no_clock_;
      return;
    }
    begin_anew_where_numbers_do(found->second, message.sequence);
    ChannelLog& log = segment_->log()[found->second];
    const bool is_added = log.add(
        {log.whole_number(message.sequence), stamp, {message.data.begin(), message.data.end()}});
    if (!is_added && !is_said_again(kRawTopics + known_[found->second].name)) {
      ++out_of_order_;
    }
    segment_->came_to(stamp, places_);
    show(stamp);
  }

  // A later part may be of another segment.
  void begin_anew_where_numbers_do(std::uint64_t place, std::uint32_t sequence) {
    if (is_checked_ || is_said_again(kRawTopics + known_[place].name)) {
      return;
    }
    const ChannelLog& log = segment_->log()[place];
    is_checked_ = log.newest() != 0;
    if (log.newest() != 0 && log.whole_number(sequence) <= log.newest()) {
      segment_->finish(places_);
      span_ += segment_->span();
      const std::vector<TaskVerdict> verdicts = segment_->verdicts();
      segment_.emplace(setup_, verdicts);
    }
  }

  void show(Time stamp) {
    shown_from_ = shown_from_.value_or(stamp);
    if (request_.show && stamp >= next_show_) {
      next_show_ = stamp + std::chrono::seconds{10};
      request_.show(stamp - *shown_from_);
    }
  }

  const ReplayRequest& request_;
  const RecordedSetup& setup_;
  std::vector<RawChannel> known_;
  std::optional<Segment> segment_;
  std::map<std::uint16_t, std::uint64_t> by_id_;
  std::vector<std::uint64_t> places_;  // by the file's number of a channel
  bool is_first_file_ = true;
  bool is_checked_ = true;  // that this file goes on in the same segment
  std::uint64_t gaps_ = 0;
  std::uint64_t of_no_clock_ = 0;
  std::uint64_t out_of_order_ = 0;
  std::vector<std::string> left_out_;
  std::vector<std::string> lacks_;
  Duration span_{};  // of segments that are done
  std::optional<Time> shown_from_;
  Time next_show_{};
};

template <class Count>
[[nodiscard]] std::uint64_t sum_of(const std::vector<TaskVerdict>& tasks, Count count) noexcept {
  std::uint64_t sum = 0;
  for (const TaskVerdict& task : tasks) {
    sum += count(task);
  }
  return sum;
}

}  // namespace

std::uint64_t ReplayResult::judged() const noexcept {
  return sum_of(tasks, [](const TaskVerdict& task) { return task.judged; });
}
std::uint64_t ReplayResult::differing() const noexcept {
  return sum_of(tasks, [](const TaskVerdict& task) { return task.differing; });
}
std::uint64_t ReplayResult::not_judged() const noexcept {
  return sum_of(tasks, [](const TaskVerdict& task) { return task.not_judged_in_all(); });
}

const Difference* ReplayResult::first() const noexcept {
  const Difference* first = nullptr;
  for (const TaskVerdict& task : tasks) {
    if (!task.differences.empty() &&
        (first == nullptr || task.differences.front().stamp < first->stamp)) {
      first = &task.differences.front();
    }
  }
  return first;
}

ReplayResult replay(const ReplayRequest& request) {
  const RecordedSetup setup = recorded_setup(request.files.front(), request.sets);
  const Stopwatch stopwatch;
  Replaying replaying{request, setup};
  for (const fs::path& file : request.files) {
    replaying.read(file);
  }
  ReplayResult result = replaying.finish();
  result.took_s = to_seconds(stopwatch.elapsed());
  return result;
}

}  // namespace lodesman::cli
