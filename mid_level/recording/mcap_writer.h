// SPDX-License-Identifier: Apache-2.0
// Writes an MCAP file: messages gathered into chunks, each compressed, checked and indexed; at the
// end a summary, by which viewers find what they want without reading all. What was written is
// whole at any time: a write that fails is cut off again, and a file that was never finished can be
// read up to its last chunk. One thread; it allocates, and its writes take as long as the disk.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "mid_level/recording/mcap_records.h"
#include "mid_level/recording/record_file.h"

namespace lodesman {

// A chunk is closed at this size by itself, so that its memory is bounded.
inline constexpr std::size_t kMcapChunk_bytes = std::size_t{1} << 20;

class McapWriter {
 public:
  // Both must outlive it. `library`: who writes.
  McapWriter(RecordFile& file, const std::string& library);
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;
  ~McapWriter();

  // The id that the file gives it; the one in it is not looked at. Up to 65535 of each.
  std::uint16_t add(McapSchema schema);
  std::uint16_t add(McapChannel channel);
  // Of a channel that was added.
  void add(const McapMessage& message);
  void add(const McapAttachment& attachment);
  void add(const McapMetadata& metadata);
  // Writes the messages that wait, if any do.
  void close_chunk();
  void sync();
  // Closes the file. Also after a fault, where the disk has room for that much.
  void finish();

  // 0, or the number (errno) of the first error: since then no message is taken, and those that
  // waited for their chunk are not in the file.
  [[nodiscard]] int fault() const noexcept { return fault_; }
  // Whether what was written may be missing too: a later sync does not tell it again (fsync(2)).
  [[nodiscard]] bool has_sync_failed() const noexcept { return sync_failed_; }
  [[nodiscard]] bool is_finished() const noexcept { return finished_; }
  [[nodiscard]] std::uint64_t size_bytes() const noexcept { return size_; }
  [[nodiscard]] std::uint64_t message_count() const noexcept { return message_count_; }
  // Chunks that are in the file.
  [[nodiscard]] std::size_t chunk_count() const noexcept { return chunks_.size(); }
  [[nodiscard]] std::size_t waiting_bytes() const noexcept { return chunk_.size(); }

 private:
  struct Place {
    std::uint64_t time_ns = 0;
    std::uint64_t offset = 0;  // of the message in its uncompressed chunk
  };
  struct Times {
    std::uint64_t first_ns = UINT64_MAX;
    std::uint64_t last_ns = 0;
    void take_in(std::uint64_t time_ns) noexcept;
  };
  struct ChunkIndex {
    Times times;
    std::uint64_t offset = 0;
    std::uint64_t length = 0;
    std::vector<std::pair<std::uint16_t, std::uint64_t>> indexes;  // channel, place in the file
    std::uint64_t indexes_length = 0;
    std::uint64_t compressed = 0;
    std::uint64_t uncompressed = 0;
  };
  struct Compressor;

  // All of it, or nothing.
  bool write(const McapPutter& record);
  [[nodiscard]] std::span<const std::byte> compressed_chunk();
  void put_chunk(McapPutter& to, std::span<const std::byte> records, ChunkIndex& index) const;
  void put_indexes(McapPutter& to, ChunkIndex& index) const;
  void put_statistics(McapPutter& to) const;
  static void put_chunk_index(McapPutter& to, const ChunkIndex& index);
  void put_summary(McapPutter& to) const;

  RecordFile& file_;
  std::unique_ptr<Compressor> compressor_;
  int fault_ = 0;
  bool sync_failed_ = false;
  bool finished_ = false;
  std::uint64_t size_ = 0;
  std::uint32_t data_crc_ = 0;  // of all that is in the file
  std::vector<McapSchema> schemas_;
  std::vector<McapChannel> channels_;
  // The chunk that is being gathered, and where each channel's messages are in it.
  McapPutter chunk_;
  Times chunk_times_;
  std::vector<std::vector<Place>> places_;
  std::uint64_t waiting_count_ = 0;
  // Of what is in the file.
  Times times_;
  std::uint64_t message_count_ = 0;
  std::vector<std::uint64_t> counts_;
  std::vector<ChunkIndex> chunks_;
  McapPutter attachment_indexes_;
  McapPutter metadata_indexes_;
  std::uint32_t attachment_count_ = 0;
  std::uint32_t metadata_count_ = 0;
};

}  // namespace lodesman
