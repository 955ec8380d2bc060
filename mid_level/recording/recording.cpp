// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/recording.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

constexpr const char* kGapsSchema = R"({
  "title": "lodesman.gap", "type": "object",
  "properties": {
    "channel": {"type": "string"},
    "first": {"type": "integer"}, "last": {"type": "integer"}, "count": {"type": "integer"},
    "cause": {"type": "string"}
  },
  "required": ["channel", "first", "last", "count", "cause"]
})";

[[nodiscard]] std::uint64_t nanoseconds(Time time) noexcept {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

}  // namespace

Recording::Recording(std::unique_ptr<RecordFile> file, const RecordingNotes& notes, Time now)
    : file_{std::move(file)}, writer_{*file_, notes.library} {
  add_attachments(notes, now);
  add_channels();
  writer_.sync();
}

Recording::~Recording() = default;

void Recording::add_attachments(const RecordingNotes& notes, Time now) {
  writer_.add(McapMetadata{kAboutRecord, notes.about});
  for (const auto& [name, text] : notes.attachments) {
    writer_.add(McapAttachment{nanoseconds(now), nanoseconds(now), name, "text/plain", text});
  }
}

void Recording::add_channels() {
  for (const RawChannel& channel : raw_channels()) {
    const std::uint16_t schema =
        writer_.add(McapSchema{0, "lodesman." + channel.name, kRawSchemaEncoding, channel.layout});
    raw_ids_.push_back(
        writer_.add(McapChannel{0, schema, kRawTopics + channel.name, kRawEncoding, {}}));
    names_.push_back(channel.name);
  }
  const std::uint16_t schema =
      writer_.add(McapSchema{0, "lodesman.gap", "jsonschema", kGapsSchema});
  gaps_id_ = writer_.add(McapChannel{0, schema, kGapsTopic, "json", {}});
  viewers_ = std::make_unique<ViewerChannels>(viewer_sink_);
  waiting_.resize(names_.size());
  unsynced_.resize(names_.size());
}

void Recording::Span::take_in(const Span& later) noexcept {
  if (later.first != 0) {
    first = first == 0 ? later.first : first;
    last = later.last;
  }
}

void Recording::add(const Publication& publication, std::span<const std::byte> raw) {
  LODESMAN_CHECK(publication.channel < raw_ids_.size());
  waiting_[publication.channel].take_in({publication.sequence, publication.sequence});
  write(publication, raw);
}

void Recording::add_again(const Publication& publication, std::span<const std::byte> raw) {
  LODESMAN_CHECK(publication.channel < raw_ids_.size());
  write(publication, raw);
}

void Recording::write(const Publication& publication, std::span<const std::byte> raw) {
  const std::uint64_t stamp = nanoseconds(publication.stamp);
  writer_.add(McapMessage{raw_ids_[publication.channel],
                          static_cast<std::uint32_t>(publication.sequence), stamp, stamp, raw});
  viewers_->take(publication, raw);
  see_what_is_written();
}

void Recording::add(const Gap& gap, Time at) {
  LODESMAN_CHECK(gap.channel < names_.size());
  const nlohmann::ordered_json told{{"channel", names_[gap.channel]},
                                    {"first", gap.first},
                                    {"last", gap.last},
                                    {"count", gap.last - gap.first + 1},
                                    {"cause", to_string(gap.cause)}};
  const std::string text = told.dump();
  writer_.add(
      McapMessage{gaps_id_, ++gap_count_, nanoseconds(at), nanoseconds(at), bytes_of(text)});
  waiting_gaps_.push_back(gap);
  see_what_is_written();
}

void Recording::close_chunk() {
  writer_.close_chunk();
  see_what_is_written();
}

void Recording::sync() {
  writer_.sync();
  forget_what_is_synced();
}

void Recording::see_what_is_written() {
  if (writer_.chunk_count() == chunks_seen_) {
    return;
  }
  chunks_seen_ = writer_.chunk_count();
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    unsynced_[i].take_in(waiting_[i]);
  }
  waiting_.assign(waiting_.size(), {});
  unsynced_gaps_.insert(unsynced_gaps_.end(), waiting_gaps_.begin(), waiting_gaps_.end());
  waiting_gaps_.clear();
}

void Recording::forget_what_is_synced() {
  if (writer_.fault() == 0) {
    unsynced_.assign(unsynced_.size(), {});
    unsynced_gaps_.clear();
  }
}

std::vector<Gap> Recording::lost() const {
  std::vector<Gap> gaps;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    Span lost = writer_.has_sync_failed() ? unsynced_[i] : Span{};
    lost.take_in(waiting_[i]);
    if (lost.first != 0) {
      gaps.push_back({static_cast<std::uint32_t>(i), GapCause::kNotWritten, lost.first, lost.last});
    }
  }
  return gaps;
}

std::vector<Gap> Recording::untold_gaps() const {
  std::vector<Gap> gaps = writer_.has_sync_failed() ? unsynced_gaps_ : std::vector<Gap>{};
  gaps.insert(gaps.end(), waiting_gaps_.begin(), waiting_gaps_.end());
  return gaps;
}

int Recording::finish() {
  close_chunk();
  writer_.finish();
  forget_what_is_synced();
  // After an error the file may have been closed all the same; then it is as whole as any.
  return writer_.is_finished() ? file_->keep() : writer_.fault();
}

}  // namespace lodesman
