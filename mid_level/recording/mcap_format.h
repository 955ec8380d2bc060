// SPDX-License-Identifier: Apache-2.0
// What stands in an MCAP file, by its public specification (mcap.dev, version 0): records of one
// opcode byte and a 64-bit length, all numbers little-endian, between two magics. Plain data and
// pure functions; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

namespace lodesman {

inline constexpr std::array<std::uint8_t, 8> kMcapMagic{0x89, 'M', 'C', 'A', 'P', '0', '\r', '\n'};
inline constexpr std::size_t kMcapRecordHead_bytes = 9;  // opcode and length

enum class McapOpcode : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0a,
  kStatistics = 0x0b,
  kMetadata = 0x0c,
  kMetadataIndex = 0x0d,
  kSummaryOffset = 0x0e,
  kDataEnd = 0x0f,
};

struct McapSchema {
  std::uint16_t id = 0;  // > 0
  std::string name;
  std::string encoding;
  std::string data;
};

struct McapChannel {
  std::uint16_t id = 0;
  std::uint16_t schema = 0;  // 0: none
  std::string topic;
  std::string message_encoding;
  std::map<std::string, std::string> metadata;
};

// The data belong to whoever hands it out.
struct McapMessage {
  std::uint16_t channel = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  std::span<const std::byte> data;
};

struct McapAttachment {
  std::uint64_t log_time_ns = 0;
  std::uint64_t create_time_ns = 0;
  std::string name;
  std::string media_type;
  std::string data;
};

struct McapMetadata {
  std::string name;
  std::map<std::string, std::string> values;
};

// CRC-32 of IEEE 802.3 (zlib's), over what came before and these bytes; 0 begins.
[[nodiscard]] std::uint32_t crc32_of(std::span<const std::byte> bytes,
                                     std::uint32_t before = 0) noexcept;

[[nodiscard]] inline std::span<const std::byte> bytes_of(const std::string& text) noexcept {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

}  // namespace lodesman
