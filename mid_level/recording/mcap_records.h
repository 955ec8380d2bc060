// SPDX-License-Identifier: Apache-2.0
// The records that both the writer and the reader of MCAP files know: put as bytes, and taken apart
// again. Pure functions; any thread.
#pragma once

#include "mid_level/recording/mcap_bytes.h"

namespace lodesman {

void put(McapPutter& to, const McapSchema& schema);
void put(McapPutter& to, const McapChannel& channel);
void put(McapPutter& to, const McapMessage& message);
void put(McapPutter& to, const McapAttachment& attachment);
void put(McapPutter& to, const McapMetadata& metadata);

// Of what follows a record's head; false where the bytes are not as they must be. A message's data
// stay where they are.
[[nodiscard]] bool take(std::span<const std::byte> from, McapSchema& schema);
[[nodiscard]] bool take(std::span<const std::byte> from, McapChannel& channel);
[[nodiscard]] bool take(std::span<const std::byte> from, McapMessage& message);
[[nodiscard]] bool take(std::span<const std::byte> from, McapAttachment& attachment);
[[nodiscard]] bool take(std::span<const std::byte> from, McapMetadata& metadata);

}  // namespace lodesman
