// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_reader.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zstd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

constexpr std::uint64_t kZstdBlockHead_bytes = 3;

// Schemas or channels of one file; their ids have 16 bits.
constexpr std::size_t kMaxKnown = 65535;

template <class T>
[[nodiscard]] const T* by_id(const std::vector<T>& all, std::uint16_t id) noexcept {
  const auto found = std::find_if(all.begin(), all.end(), [id](const T& t) { return t.id == id; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace

bool McapBytesSource::read(std::uint64_t offset, std::span<std::byte> into) noexcept {
  if (offset > bytes_.size() || into.size() > bytes_.size() - offset) {
    return false;
  }
  std::copy_n(bytes_.begin() + static_cast<std::ptrdiff_t>(offset), into.size(), into.begin());
  return true;
}

McapFileSource::McapFileSource(const std::filesystem::path& path)
    : descriptor_{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)} {
  struct stat about {};
  const bool opened = descriptor_ >= 0 && fstat(descriptor_, &about) == 0;
  if (!opened || !S_ISREG(about.st_mode)) {
    const std::string why = opened ? "is no file" : std::generic_category().message(errno);
    if (descriptor_ >= 0) {
      close(descriptor_);
    }
    throw StartupError(path.string() + ": " + why);
  }
  size_ = static_cast<std::uint64_t>(about.st_size);
}

McapFileSource::~McapFileSource() { close(descriptor_); }

bool McapFileSource::is_being_written() const noexcept {
  const bool locked = flock(descriptor_, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  static_cast<void>(flock(descriptor_, LOCK_UN));
  return locked;
}

bool McapFileSource::read(std::uint64_t offset, std::span<std::byte> into) noexcept {
  while (!into.empty()) {
    const ssize_t count = pread(descriptor_, into.data(), into.size(), static_cast<off_t>(offset));
    if (count == 0 || (count < 0 && errno != EINTR)) {
      return false;
    }
    const auto taken = count < 0 ? 0 : static_cast<std::size_t>(count);
    offset += taken;
    into = into.subspan(taken);
  }
  return true;
}

McapReader::McapReader(McapSource& source) : source_{source} {
  std::array<std::uint8_t, kMcapMagic.size()> magic{};
  if (source_.size_bytes() < magic.size()) {
    end(McapEnding::kCutOff, "is shorter than the first eight bytes of an MCAP file");
  } else if (!source_.read(0, std::as_writable_bytes(std::span{magic})) || magic != kMcapMagic) {
    end(McapEnding::kDamaged, "is no MCAP file");
  } else {
    position_ = magic.size();
    crc_ = crc32_of(std::as_bytes(std::span{magic}));
  }
}

McapReader::~McapReader() = default;

const McapChannel* McapReader::channel_by_id(std::uint16_t id) const noexcept {
  return by_id(channels_, id);
}

const McapSchema* McapReader::schema_by_id(std::uint16_t id) const noexcept {
  return by_id(schemas_, id);
}

void McapReader::end(McapEnding how, const std::string& why) {
  ending_ = how;
  reason_ = why;
}

bool McapReader::load() {
  const std::uint64_t left = source_.size_bytes() - position_;
  std::array<std::byte, kMcapRecordHead_bytes> head{};
  if (left < head.size()) {
    end(McapEnding::kCutOff, "was never finished");
    return false;
  }
  const bool read = source_.read(position_, head);
  McapTaker taker{head};
  code_ = static_cast<McapOpcode>(taker.number<std::uint8_t>());
  const auto length = taker.number<std::uint64_t>();
  if (!read || code_ == McapOpcode{} || length > kMaxRecord_bytes) {
    end(McapEnding::kDamaged, read ? "what follows is no record" : "cannot be read");
    return false;
  }
  if (length > left - head.size()) {
    end(McapEnding::kCutOff, "ends in the middle of a record");
    return false;
  }
  record_.resize(head.size() + static_cast<std::size_t>(length));
  if (!source_.read(position_, record_)) {
    end(McapEnding::kDamaged, "cannot be read");
    return false;
  }
  position_ += record_.size();
  return true;
}

McapItem McapReader::next() {
  McapItem item = McapItem::kEnd;
  while (ending_ == McapEnding::kOpen) {
    if (!chunk_left_.empty()) {
      if (next_in_chunk(item)) {
        return item;
      }
      continue;
    }
    if (!load()) {
      break;
    }
    const auto content = std::span<const std::byte>{record_}.subspan(kMcapRecordHead_bytes);
    if (code_ == McapOpcode::kDataEnd) {
      take_data_end(content);
      continue;
    }
    if (code_ == McapOpcode::kFooter) {
      take_footer(content);
      break;
    }
    crc_ = crc32_of(record_, crc_);
    if (in_summary_) {
      continue;  // it says again what has come
    }
    if (code_ == McapOpcode::kChunk) {
      open_chunk(content);
    } else if (take_in(code_, content, item)) {
      return item;
    }
  }
  return McapItem::kEnd;
}

bool McapReader::next_in_chunk(McapItem& item) {
  McapTaker taker{chunk_left_};
  const auto code = static_cast<McapOpcode>(taker.number<std::uint8_t>());
  const auto content = taker.raw(taker.number<std::uint64_t>());
  if (!taker.is_whole()) {
    ++damaged_;
    chunk_left_ = {};
    return false;
  }
  chunk_left_ = taker.rest();
  return take_in(code, content, item);
}

bool McapReader::take_in(McapOpcode code, std::span<const std::byte> content, McapItem& item) {
  switch (code) {
    case McapOpcode::kSchema: item = McapItem::kSchema; return take_schema(content);
    case McapOpcode::kChannel: item = McapItem::kChannel; return take_channel(content);
    case McapOpcode::kMessage: item = McapItem::kMessage; return take_message(content);
    case McapOpcode::kAttachment:
      item = McapItem::kAttachment;
      if (take(content, attachment_)) {
        return true;
      }
      break;
    case McapOpcode::kMetadata:
      item = McapItem::kMetadata;
      if (take(content, metadata_)) {
        return true;
      }
      break;
    default: return false;  // an index, or of a later version
  }
  ++damaged_;
  return false;
}

bool McapReader::take_schema(std::span<const std::byte> content) {
  McapSchema schema;
  if (!take(content, schema)) {
    ++damaged_;
    return false;
  }
  if (schema_by_id(schema.id) != nullptr || schemas_.size() >= kMaxKnown) {
    return false;
  }
  schemas_.push_back(std::move(schema));
  return true;
}

bool McapReader::take_channel(std::span<const std::byte> content) {
  McapChannel channel;
  if (!take(content, channel) || (channel.schema != 0 && schema_by_id(channel.schema) == nullptr)) {
    ++damaged_;
    return false;
  }
  if (channel_by_id(channel.id) != nullptr || channels_.size() >= kMaxKnown) {
    return false;
  }
  channels_.push_back(std::move(channel));
  return true;
}

bool McapReader::take_message(std::span<const std::byte> content) {
  if (!take(content, message_) || channel_by_id(message_.channel) == nullptr) {
    ++damaged_;
    return false;
  }
  return true;
}

bool McapReader::unpack(const std::string& compression, std::span<const std::byte> packed,
                        std::uint64_t size) {
  if (size > kMaxRecord_bytes || (compression.empty() && size != packed.size())) {
    return false;
  }
  if (compression.empty()) {
    chunk_.assign(packed.begin(), packed.end());
    return true;
  }
  // What the frame itself says of its size is asked before room is made for it. One that was
  // compressed as a stream may say nothing; then the chunk's word has to do, as far as that many
  // bytes can hold that much (RFC 8878, 3.1.1.2: a block has a head, and gives 128 KiB at most).
  const auto told = ZSTD_getFrameContentSize(packed.data(), packed.size());
  const bool can_hold = size / ZSTD_BLOCKSIZE_MAX * kZstdBlockHead_bytes <= packed.size();
  if (compression != "zstd" || (told != size && (told != ZSTD_CONTENTSIZE_UNKNOWN || !can_hold))) {
    return false;
  }
  chunk_.resize(static_cast<std::size_t>(size));
  return ZSTD_decompress(chunk_.data(), chunk_.size(), packed.data(), packed.size()) == size;
}

void McapReader::open_chunk(std::span<const std::byte> content) {
  McapTaker taker{content};
  static_cast<void>(taker.number<std::uint64_t>());  // its messages say when they are
  static_cast<void>(taker.number<std::uint64_t>());
  const auto size = taker.number<std::uint64_t>();
  const auto crc = taker.number<std::uint32_t>();
  const std::string compression = taker.text();
  const auto packed = taker.raw(taker.number<std::uint64_t>());
  if (!taker.is_whole() || !unpack(compression, packed, size) ||
      (crc != 0 && crc != crc32_of(chunk_))) {
    ++damaged_;
    return;
  }
  ++chunk_count_;
  chunk_left_ = chunk_;
}

void McapReader::take_data_end(std::span<const std::byte> content) {
  McapTaker taker{content};
  const auto crc = taker.number<std::uint32_t>();
  if (!taker.is_whole() || (crc != 0 && crc != crc_)) {
    ++damaged_;
  }
  in_summary_ = true;
  crc_ = 0;
}

void McapReader::take_footer(std::span<const std::byte> content) {
  McapTaker taker{content};
  static_cast<void>(taker.number<std::uint64_t>());
  static_cast<void>(taker.number<std::uint64_t>());
  // Over the summary and the footer up to the CRC itself.
  const std::uint32_t seen = crc32_of(std::span{record_}.first(record_.size() - 4), crc_);
  const auto crc = taker.number<std::uint32_t>();
  std::array<std::uint8_t, kMcapMagic.size()> magic{};
  const bool there = source_.size_bytes() - position_ >= magic.size() &&
                     source_.read(position_, std::as_writable_bytes(std::span{magic}));
  if (!there) {
    end(McapEnding::kCutOff, "lacks its last bytes");
    return;
  }
  if (!taker.is_whole() || magic != kMcapMagic || !in_summary_ || (crc != 0 && crc != seen)) {
    end(McapEnding::kDamaged, "its summary is damaged");
    return;
  }
  position_ += magic.size();
  ending_ = McapEnding::kWhole;
}

}  // namespace lodesman
