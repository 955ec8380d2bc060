// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_writer.h"

#include <zstd.h>

#include <algorithm>
#include <utility>

#include "mid_level/base/check.h"

namespace lodesman {
namespace {

// Sonar images are mostly noise, which no level makes smaller.
constexpr int kCompressionLevel = 1;
constexpr const char* kZstd = "zstd";
constexpr std::uint64_t kFooter_bytes = 20;

}  // namespace

struct McapWriter::Compressor {
  Compressor() = default;
  Compressor(const Compressor&) = delete;
  Compressor& operator=(const Compressor&) = delete;
  ~Compressor() { ZSTD_freeCCtx(context); }

  ZSTD_CCtx* context = ZSTD_createCCtx();
  std::vector<std::byte> output;
};

void McapWriter::Times::take_in(std::uint64_t time_ns) noexcept {
  first_ns = std::min(first_ns, time_ns);
  last_ns = std::max(last_ns, time_ns);
}

McapWriter::McapWriter(RecordFile& file, const std::string& library)
    : file_{file}, compressor_{std::make_unique<Compressor>()} {
  LODESMAN_CHECK(compressor_->context != nullptr);
  McapPutter head;
  head.magic();
  const std::size_t place = head.begin_record(McapOpcode::kHeader);
  head.text("");  // no profile
  head.text(library);
  head.end_record(place);
  write(head);
}

McapWriter::~McapWriter() = default;

bool McapWriter::write(const McapPutter& record) {
  if (fault_ != 0) {
    return false;
  }
  fault_ = file_.write(record.bytes());
  if (fault_ != 0) {
    static_cast<void>(file_.cut_to(size_));  // where even that fails a reader stops there
    return false;
  }
  data_crc_ = crc32_of(record.bytes(), data_crc_);
  size_ += record.size();
  return true;
}

std::uint16_t McapWriter::add(McapSchema schema) {
  LODESMAN_CHECK(schemas_.size() < UINT16_MAX);
  schema.id = static_cast<std::uint16_t>(schemas_.size() + 1);
  McapPutter record;
  put(record, schema);
  write(record);
  schemas_.push_back(std::move(schema));
  return schemas_.back().id;
}

std::uint16_t McapWriter::add(McapChannel channel) {
  LODESMAN_CHECK(channels_.size() < UINT16_MAX);
  channel.id = static_cast<std::uint16_t>(channels_.size() + 1);
  McapPutter record;
  put(record, channel);
  write(record);
  channels_.push_back(std::move(channel));
  places_.emplace_back();
  counts_.push_back(0);
  return channels_.back().id;
}

void McapWriter::add(const McapMessage& message) {
  LODESMAN_CHECK(message.channel > 0 && message.channel <= channels_.size());
  if (fault_ != 0 || finished_) {
    return;
  }
  places_[message.channel - 1U].push_back({message.log_time_ns, chunk_.size()});
  put(chunk_, message);
  chunk_times_.take_in(message.log_time_ns);
  ++waiting_count_;
  if (chunk_.size() >= kMcapChunk_bytes) {
    close_chunk();
  }
}

void McapWriter::add(const McapAttachment& attachment) {
  McapPutter record;
  put(record, attachment);
  const std::uint64_t offset = size_;
  if (!write(record)) {
    return;
  }
  ++attachment_count_;
  const std::size_t place = attachment_indexes_.begin_record(McapOpcode::kAttachmentIndex);
  attachment_indexes_.number(offset);
  attachment_indexes_.number(std::uint64_t{record.size()});
  attachment_indexes_.number(attachment.log_time_ns);
  attachment_indexes_.number(attachment.create_time_ns);
  attachment_indexes_.number(std::uint64_t{attachment.data.size()});
  attachment_indexes_.text(attachment.name);
  attachment_indexes_.text(attachment.media_type);
  attachment_indexes_.end_record(place);
}

void McapWriter::add(const McapMetadata& metadata) {
  McapPutter record;
  put(record, metadata);
  const std::uint64_t offset = size_;
  if (!write(record)) {
    return;
  }
  ++metadata_count_;
  const std::size_t place = metadata_indexes_.begin_record(McapOpcode::kMetadataIndex);
  metadata_indexes_.number(offset);
  metadata_indexes_.number(std::uint64_t{record.size()});
  metadata_indexes_.text(metadata.name);
  metadata_indexes_.end_record(place);
}

std::span<const std::byte> McapWriter::compressed_chunk() {
  std::vector<std::byte>& output = compressor_->output;
  output.resize(ZSTD_compressBound(chunk_.size()));
  const std::size_t size =
      ZSTD_compressCCtx(compressor_->context, output.data(), output.size(), chunk_.bytes().data(),
                        chunk_.size(), kCompressionLevel);
  LODESMAN_CHECK(ZSTD_isError(size) == 0U);  // there is room for the worst
  return std::span{output}.first(size);
}

void McapWriter::put_chunk(McapPutter& to, std::span<const std::byte> records,
                           ChunkIndex& index) const {
  index.offset = size_;
  index.times = chunk_times_;
  index.compressed = records.size();
  index.uncompressed = chunk_.size();
  const std::size_t place = to.begin_record(McapOpcode::kChunk);
  to.number(index.times.first_ns);
  to.number(index.times.last_ns);
  to.number(index.uncompressed);
  to.number(crc32_of(chunk_.bytes()));
  to.text(kZstd);
  to.number(index.compressed);
  to.raw(records);
  to.end_record(place);
  index.length = to.size();
}

void McapWriter::put_indexes(McapPutter& to, ChunkIndex& index) const {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    if (places_[i].empty()) {
      continue;
    }
    const auto channel = static_cast<std::uint16_t>(i + 1);
    index.indexes.emplace_back(channel, size_ + to.size());
    const std::size_t place = to.begin_record(McapOpcode::kMessageIndex);
    to.number(channel);
    const std::size_t list = to.begin<std::uint32_t>();
    for (const Place& message : places_[i]) {
      to.number(message.time_ns);
      to.number(message.offset);
    }
    to.end<std::uint32_t>(list);
    to.end_record(place);
  }
  index.indexes_length = to.size() - index.length;
}

void McapWriter::close_chunk() {
  if (fault_ != 0 || chunk_.size() == 0) {
    return;
  }
  ChunkIndex index;
  McapPutter record;
  put_chunk(record, compressed_chunk(), index);
  put_indexes(record, index);
  const bool written = write(record);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    counts_[i] += written ? places_[i].size() : 0;
    places_[i].clear();
  }
  if (written) {
    chunks_.push_back(std::move(index));
    times_.take_in(chunk_times_.first_ns);
    times_.take_in(chunk_times_.last_ns);
    message_count_ += waiting_count_;
  }
  chunk_.clear();
  chunk_times_ = {};
  waiting_count_ = 0;
}

void McapWriter::sync() {
  if (fault_ == 0) {
    fault_ = file_.sync();
    sync_failed_ = sync_failed_ || fault_ != 0;
  }
}

void McapWriter::put_statistics(McapPutter& to) const {
  const std::size_t place = to.begin_record(McapOpcode::kStatistics);
  to.number(message_count_);
  to.number(static_cast<std::uint16_t>(schemas_.size()));
  to.number(static_cast<std::uint32_t>(channels_.size()));
  to.number(attachment_count_);
  to.number(metadata_count_);
  to.number(static_cast<std::uint32_t>(chunks_.size()));
  to.number(message_count_ == 0 ? std::uint64_t{0} : times_.first_ns);
  to.number(times_.last_ns);
  const std::size_t list = to.begin<std::uint32_t>();
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    if (counts_[i] > 0) {
      to.number(static_cast<std::uint16_t>(i + 1));
      to.number(counts_[i]);
    }
  }
  to.end<std::uint32_t>(list);
  to.end_record(place);
}

void McapWriter::put_chunk_index(McapPutter& to, const ChunkIndex& index) {
  const std::size_t place = to.begin_record(McapOpcode::kChunkIndex);
  to.number(index.times.first_ns);
  to.number(index.times.last_ns);
  to.number(index.offset);
  to.number(index.length);
  const std::size_t list = to.begin<std::uint32_t>();
  for (const auto& [channel, offset] : index.indexes) {
    to.number(channel);
    to.number(offset);
  }
  to.end<std::uint32_t>(list);
  to.number(index.indexes_length);
  to.text(kZstd);
  to.number(index.compressed);
  to.number(index.uncompressed);
  to.end_record(place);
}

// The whole end of the file: the data's end, the summary with its groups and where they are, the
// footer and the second magic.
void McapWriter::put_summary(McapPutter& to) const {
  const std::size_t data_end = to.begin_record(McapOpcode::kDataEnd);
  to.number(data_crc_);
  to.end_record(data_end);
  const std::size_t summary = to.size();
  McapPutter offsets;
  const auto group = [&](McapOpcode code, auto fill) {
    const std::size_t start = to.size();
    fill();
    if (to.size() == start) {
      return;
    }
    const std::size_t place = offsets.begin_record(McapOpcode::kSummaryOffset);
    offsets.opcode(code);
    offsets.number(size_ + start);
    offsets.number(std::uint64_t{to.size() - start});
    offsets.end_record(place);
  };
  const auto each = [&to](const auto& records) {
    for (const auto& record : records) {
      put(to, record);
    }
  };
  group(McapOpcode::kSchema, [&] { each(schemas_); });
  group(McapOpcode::kChannel, [&] { each(channels_); });
  group(McapOpcode::kStatistics, [&] { put_statistics(to); });
  group(McapOpcode::kChunkIndex, [&] {
    for (const ChunkIndex& index : chunks_) {
      put_chunk_index(to, index);
    }
  });
  group(McapOpcode::kAttachmentIndex, [&] { to.raw(attachment_indexes_.bytes()); });
  group(McapOpcode::kMetadataIndex, [&] { to.raw(metadata_indexes_.bytes()); });
  const std::size_t offsets_at = to.size();
  to.raw(offsets.bytes());
  // Its length is a part of what the CRC is over, and so must stand there by then.
  to.opcode(McapOpcode::kFooter);
  to.number(kFooter_bytes);
  to.number(size_ + summary);
  to.number(size_ + offsets_at);
  to.number(crc32_of(to.bytes().subspan(summary)));
  to.magic();
}

void McapWriter::finish() {
  close_chunk();
  if (finished_) {
    return;
  }
  const int before = std::exchange(fault_, 0);
  McapPutter end;
  put_summary(end);
  finished_ = write(end);
  sync();
  fault_ = before != 0 ? before : fault_;
}

}  // namespace lodesman
