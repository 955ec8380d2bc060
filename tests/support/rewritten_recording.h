// SPDX-License-Identifier: Apache-2.0
// A recording written once more with other messages, every check sum right: what no torn file has,
// and a forged one may.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mid_level/recording/mcap_reader.h"
#include "mid_level/recording/mcap_writer.h"
#include "tests/support/catch.h"

namespace lodesman::testing {

struct RewrittenMessage {
  std::string topic;
  McapMessage head;  // without its data
  std::vector<std::byte> data;
};

// Asked of each message, which it may change: whether it is to be in the new file.
using Rewrite = std::function<bool(RewrittenMessage&)>;

// Of the attachments all but the one of that name are in it.
inline void rewrite_recording(const std::filesystem::path& from, const std::filesystem::path& to,
                              const Rewrite& rewrite, const std::string& without = {}) {
  std::filesystem::remove(to);
  McapFileSource source{from};
  McapReader reader{source};
  DiskFile file{to};
  McapWriter writer{file, "test"};
  std::map<std::uint16_t, std::uint16_t> ids;
  for (McapItem item = reader.next(); item != McapItem::kEnd; item = reader.next()) {
    if (item == McapItem::kMetadata) {
      writer.add(reader.metadata());
    } else if (item == McapItem::kAttachment && reader.attachment().name != without) {
      writer.add(reader.attachment());
    } else if (item == McapItem::kChannel) {
      McapChannel channel = reader.channel();
      channel.schema = writer.add(*reader.schema_by_id(channel.schema));
      ids[channel.id] = writer.add(channel);
    } else if (item == McapItem::kMessage) {
      const McapMessage& read = reader.message();
      RewrittenMessage message{
          reader.channel_by_id(read.channel)->topic, read, {read.data.begin(), read.data.end()}};
      if (rewrite(message)) {
        message.head.channel = ids[read.channel];
        message.head.data = message.data;
        writer.add(message.head);
      }
    }
  }
  writer.finish();
  REQUIRE(file.keep() == 0);
}

}  // namespace lodesman::testing
