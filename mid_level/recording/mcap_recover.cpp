// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_recover.h"

#include <algorithm>
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

void count(const McapMessage& message, McapRecovery& recovery) {
  ++recovery.messages;
  recovery.first_ns = std::min(recovery.first_ns, message.log_time_ns);
  recovery.last_ns = std::max(recovery.last_ns, message.log_time_ns);
}

void end(const McapReader& reader, const McapSource& from, McapRecovery& recovery) {
  recovery.ending = reader.ending();
  recovery.chunks = reader.chunk_count();
  recovery.damaged = reader.damaged();
  recovery.lost_bytes = from.size_bytes() - reader.position();
  recovery.reason = recovery.ending == McapEnding::kWhole && recovery.damaged > 0
                        ? "is closed, but damaged in between"
                        : reader.reason();
}

}  // namespace

McapRecovery recover(McapSource& from, McapWriter& to) {
  McapReader reader{from};
  McapRecovery recovery;
  Ids ids;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    copy(item, reader, ids, to);
    if (item == McapItem::kMessage) {
      count(reader.message(), recovery);
    }
  }
  to.close_chunk();
  end(reader, from, recovery);
  to.add(McapMetadata{"recovered",
                      {{"reason", recovery.reason},
                       {"damaged", std::to_string(recovery.damaged)},
                       {"lost_bytes", std::to_string(recovery.lost_bytes)}}});
  to.finish();
  return recovery;
}

McapRecovery look_through(McapSource& from) {
  McapReader reader{from};
  McapRecovery recovery;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMessage) {
      count(reader.message(), recovery);
    }
  }
  end(reader, from, recovery);
  return recovery;
}

}  // namespace lodesman
