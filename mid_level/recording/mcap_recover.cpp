// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_recover.h"

#include <map>

namespace lodesman {
namespace {

// From the old file's ids to the new one's.
struct Ids {
  std::map<std::uint16_t, std::uint16_t> schemas;
  std::map<std::uint16_t, std::uint16_t> channels;
};

void copy(McapItem item, const McapReader& reader, Ids& ids, McapWriter& to) {
  switch (item) {
    case McapItem::kSchema: ids.schemas[reader.schema().id] = to.add(reader.schema()); break;
    case McapItem::kChannel: {
      McapChannel channel = reader.channel();
      channel.schema = channel.schema == 0 ? std::uint16_t{0} : ids.schemas.at(channel.schema);
      ids.channels[reader.channel().id] = to.add(channel);
      break;
    }
    case McapItem::kMessage: {
      McapMessage message = reader.message();
      message.channel = ids.channels.at(message.channel);
      to.add(message);
      break;
    }
    case McapItem::kAttachment: to.add(reader.attachment()); break;
    case McapItem::kMetadata: to.add(reader.metadata()); break;
    case McapItem::kEnd: break;
  }
}

[[nodiscard]] McapRecovery ended(const McapReader& reader, const McapSource& from,
                                 std::uint64_t messages) {
  return {reader.ending(),      reader.reason(),  messages,
          reader.chunk_count(), reader.damaged(), from.size_bytes() - reader.position()};
}

}  // namespace

McapRecovery recover(McapSource& from, McapWriter& to) {
  McapReader reader{from};
  Ids ids;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    copy(item, reader, ids, to);
  }
  to.close_chunk();
  McapRecovery recovery = ended(reader, from, to.message_count());
  to.add(McapMetadata{"recovered",
                      {{"reason", recovery.reason},
                       {"damaged", std::to_string(recovery.damaged)},
                       {"lost_bytes", std::to_string(recovery.lost_bytes)}}});
  to.finish();
  return recovery;
}

McapRecovery look_through(McapSource& from) {
  McapReader reader{from};
  std::uint64_t messages = 0;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    messages += item == McapItem::kMessage ? 1 : 0;
  }
  return ended(reader, from, messages);
}

}  // namespace lodesman
