// SPDX-License-Identifier: Apache-2.0
// What is made for people's eyes, into a recording: a channel a topic, its messages counted from 1.
// The writer's thread.
#pragma once

#include <vector>

#include "mid_level/recording/mcap_writer.h"
#include "mid_level/recording/viewer_sink.h"

namespace lodesman {

class McapViewerSink final : public ViewerSink {
 public:
  // `writer` must outlive it.
  explicit McapViewerSink(McapWriter& writer) noexcept : writer_{writer} {}

  [[nodiscard]] std::uint16_t add_topic(const std::string& name,
                                        const viewer::Shape& shape) override;
  void publish(std::uint16_t topic, const std::string& part, Time stamp,
               const std::string& json) override;

 private:
  McapWriter& writer_;
  std::vector<std::uint32_t> counts_;  // by channel
};

}  // namespace lodesman
