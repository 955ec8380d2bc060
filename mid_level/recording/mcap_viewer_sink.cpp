// SPDX-License-Identifier: Apache-2.0
#include "mid_level/recording/mcap_viewer_sink.h"

#include <algorithm>

namespace lodesman {

std::uint16_t McapViewerSink::add_topic(const std::string& name, const viewer::Shape& shape) {
  const std::uint16_t schema =
      writer_.add(McapSchema{0, shape.name, "jsonschema", shape.schema.dump()});
  const std::uint16_t channel = writer_.add(McapChannel{0, schema, name, "json", {}});
  counts_.resize(std::max<std::size_t>(counts_.size(), channel + std::size_t{1}));
  return channel;
}

void McapViewerSink::publish(std::uint16_t topic, const std::string& /*part*/, Time stamp,
                             const std::string& json) {
  const auto ns = static_cast<std::uint64_t>(stamp.time_since_epoch().count());
  writer_.add(McapMessage{topic, ++counts_[topic], ns, ns, bytes_of(json)});
}

}  // namespace lodesman
