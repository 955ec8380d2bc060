// SPDX-License-Identifier: Apache-2.0
// Reads an MCAP file from its beginning, one item after another, whether it was finished or cut
// off, and whatever its bytes: what fails its check is left out and counted, and no size that a
// file claims is believed beyond a bound. It looks at no index. One thread; it allocates.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mid_level/recording/mcap_records.h"

namespace lodesman {

// Bytes by their place.
class McapSource {
 public:
  McapSource() = default;
  McapSource(const McapSource&) = delete;
  McapSource& operator=(const McapSource&) = delete;
  virtual ~McapSource() = default;
  [[nodiscard]] virtual std::uint64_t size_bytes() const noexcept = 0;
  // False where they cannot be read.
  [[nodiscard]] virtual bool read(std::uint64_t offset, std::span<std::byte> into) noexcept = 0;
};

class McapBytesSource final : public McapSource {
 public:
  explicit McapBytesSource(std::span<const std::byte> bytes) noexcept : bytes_{bytes} {}
  [[nodiscard]] std::uint64_t size_bytes() const noexcept override { return bytes_.size(); }
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> into) noexcept override;

 private:
  std::span<const std::byte> bytes_;
};

class McapFileSource final : public McapSource {
 public:
  // Throws StartupError where it cannot be opened.
  explicit McapFileSource(const std::filesystem::path& path);
  McapFileSource(const McapFileSource&) = delete;
  McapFileSource& operator=(const McapFileSource&) = delete;
  ~McapFileSource() override;
  [[nodiscard]] std::uint64_t size_bytes() const noexcept override { return size_; }
  [[nodiscard]] bool read(std::uint64_t offset, std::span<std::byte> into) noexcept override;
  // Whether a living DiskFile has it.
  [[nodiscard]] bool is_being_written() const noexcept;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

enum class McapItem : std::uint8_t { kSchema, kChannel, kMessage, kAttachment, kMetadata, kEnd };

enum class McapEnding : std::uint8_t {
  kOpen,     // there is more
  kWhole,    // the file was finished
  kCutOff,   // it ends in the middle
  kDamaged,  // what follows is no MCAP
};

class McapReader {
 public:
  // No record and no chunk is believed to be larger.
  static constexpr std::uint64_t kMaxRecord_bytes = std::uint64_t{1} << 28;

  // It must outlive the reader.
  explicit McapReader(McapSource& source);
  McapReader(const McapReader&) = delete;
  McapReader& operator=(const McapReader&) = delete;
  ~McapReader();

  // What comes next, and stays until the next call: a schema or channel once, whatever the file
  // repeats; messages of known channels; kEnd for ever after the last.
  [[nodiscard]] McapItem next();
  [[nodiscard]] const McapSchema& schema() const noexcept { return schemas_.back(); }
  [[nodiscard]] const McapChannel& channel() const noexcept { return channels_.back(); }
  [[nodiscard]] const McapMessage& message() const noexcept { return message_; }
  [[nodiscard]] const McapAttachment& attachment() const noexcept { return attachment_; }
  [[nodiscard]] const McapMetadata& metadata() const noexcept { return metadata_; }

  // By id, of those that have come; nullptr for others.
  [[nodiscard]] const McapChannel* channel_by_id(std::uint16_t id) const noexcept;
  [[nodiscard]] const McapSchema* schema_by_id(std::uint16_t id) const noexcept;

  [[nodiscard]] McapEnding ending() const noexcept { return ending_; }
  // In words, where it is not whole.
  [[nodiscard]] const std::string& reason() const noexcept { return reason_; }
  // Up to here all that could be used was.
  [[nodiscard]] std::uint64_t position() const noexcept { return position_; }
  // Records and chunks that failed their checks, and were left out.
  [[nodiscard]] std::uint64_t damaged() const noexcept { return damaged_; }
  [[nodiscard]] std::uint64_t chunk_count() const noexcept { return chunk_count_; }

 private:
  void end(McapEnding how, const std::string& why);
  // The next record of the file, in record_; false at the end.
  bool load();
  // Of the file's own level, or of the chunk that is open.
  [[nodiscard]] bool take_in(McapOpcode code, std::span<const std::byte> content, McapItem& item);
  [[nodiscard]] bool take_schema(std::span<const std::byte> content);
  [[nodiscard]] bool take_channel(std::span<const std::byte> content);
  [[nodiscard]] bool take_message(std::span<const std::byte> content);
  [[nodiscard]] bool next_in_chunk(McapItem& item);
  void open_chunk(std::span<const std::byte> content);
  [[nodiscard]] bool unpack(const std::string& compression, std::span<const std::byte> packed,
                            std::uint64_t size);
  void take_data_end(std::span<const std::byte> content);
  void take_footer(std::span<const std::byte> content);

  McapSource& source_;
  std::uint64_t position_ = 0;
  McapEnding ending_ = McapEnding::kOpen;
  std::string reason_;
  std::uint64_t damaged_ = 0;
  std::uint64_t chunk_count_ = 0;
  bool in_summary_ = false;
  std::uint32_t crc_ = 0;  // of all before position_, or of the summary
  McapOpcode code_{};
  std::vector<std::byte> record_;  // with its head
  std::vector<std::byte> chunk_;
  std::span<const std::byte> chunk_left_;
  std::vector<McapSchema> schemas_;
  std::vector<McapChannel> channels_;
  McapMessage message_;
  McapAttachment attachment_;
  McapMetadata metadata_;
};

}  // namespace lodesman
