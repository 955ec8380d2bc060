// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_records.h"

#include <zlib.h>

#include <algorithm>

namespace lodesman {

std::uint32_t crc32_of(std::span<const std::byte> bytes, std::uint32_t before) noexcept {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void put(McapPutter& to, const McapSchema& schema) {
  const std::size_t place = to.begin_record(McapOpcode::kSchema);
  to.number(schema.id);
  to.text(schema.name);
  to.text(schema.encoding);
  to.text(schema.data);
  to.end_record(place);
}

void put(McapPutter& to, const McapChannel& channel) {
  const std::size_t place = to.begin_record(McapOpcode::kChannel);
  to.number(channel.id);
  to.number(channel.schema);
  to.text(channel.topic);
  to.text(channel.message_encoding);
  to.map(channel.metadata);
  to.end_record(place);
}

void put(McapPutter& to, const McapMessage& message) {
  const std::size_t place = to.begin_record(McapOpcode::kMessage);
  to.number(message.channel);
  to.number(message.sequence);
  to.number(message.log_time_ns);
  to.number(message.publish_time_ns);
  to.raw(message.data);
  to.end_record(place);
}

void put(McapPutter& to, const McapAttachment& attachment) {
  const std::size_t place = to.begin_record(McapOpcode::kAttachment);
  to.number(attachment.log_time_ns);
  to.number(attachment.create_time_ns);
  to.text(attachment.name);
  to.text(attachment.media_type);
  to.number(static_cast<std::uint64_t>(attachment.data.size()));
  to.raw(bytes_of(attachment.data));
  to.number(crc32_of(to.bytes().subspan(place)));
  to.end_record(place);
}

void put(McapPutter& to, const McapMetadata& metadata) {
  const std::size_t place = to.begin_record(McapOpcode::kMetadata);
  to.text(metadata.name);
  to.map(metadata.values);
  to.end_record(place);
}

bool take(std::span<const std::byte> from, McapSchema& schema) {
  McapTaker taker{from};
  schema.id = taker.number<std::uint16_t>();
  schema.name = taker.text();
  schema.encoding = taker.text();
  schema.data = taker.text();
  return taker.is_whole() && schema.id > 0;
}

bool take(std::span<const std::byte> from, McapChannel& channel) {
  McapTaker taker{from};
  channel.id = taker.number<std::uint16_t>();
  channel.schema = taker.number<std::uint16_t>();
  channel.topic = taker.text();
  channel.message_encoding = taker.text();
  channel.metadata = taker.map();
  return taker.is_whole();
}

bool take(std::span<const std::byte> from, McapMessage& message) {
  McapTaker taker{from};
  message.channel = taker.number<std::uint16_t>();
  message.sequence = taker.number<std::uint32_t>();
  message.log_time_ns = taker.number<std::uint64_t>();
  message.publish_time_ns = taker.number<std::uint64_t>();
  message.data = taker.rest();
  return taker.is_whole();
}

bool take(std::span<const std::byte> from, McapAttachment& attachment) {
  McapTaker taker{from};
  attachment.log_time_ns = taker.number<std::uint64_t>();
  attachment.create_time_ns = taker.number<std::uint64_t>();
  attachment.name = taker.text();
  attachment.media_type = taker.text();
  const auto data = taker.raw(taker.number<std::uint64_t>());
  attachment.data.assign(reinterpret_cast<const char*>(data.data()), data.size());
  const auto crc = taker.number<std::uint32_t>();
  return taker.is_whole() && (crc == 0 || crc == crc32_of(from.first(from.size() - 4)));
}

bool take(std::span<const std::byte> from, McapMetadata& metadata) {
  McapTaker taker{from};
  metadata.name = taker.text();
  metadata.values = taker.map();
  return taker.is_whole();
}

}  // namespace lodesman
