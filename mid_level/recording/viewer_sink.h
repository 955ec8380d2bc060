// SPDX-License-Identifier: Apache-2.0
// Where ViewerChannels puts what it makes for people's eyes: a recording's file, or whoever looks
// on over a network. The thread of whoever makes it.
#pragma once

#include <cstdint>
#include <string>

#include "mid_level/base/time.h"
#include "mid_level/recording/viewer_json.h"

namespace lodesman {

class ViewerSink {
 public:
  ViewerSink() = default;
  ViewerSink(const ViewerSink&) = delete;
  ViewerSink& operator=(const ViewerSink&) = delete;
  virtual ~ViewerSink() = default;

  // A topic of JSON messages, in that shape; the number by which it is published.
  [[nodiscard]] virtual std::uint16_t add_topic(const std::string& name,
                                                const viewer::Shape& shape) = 0;
  // `part`: which of the things that stand side by side in that topic the message is of (an entity
  // of a scene, who speaks in a log), so that whoever keeps the newest keeps one of each; empty
  // where there is one alone.
  virtual void publish(std::uint16_t topic, const std::string& part, Time stamp,
                       const std::string& json) = 0;
};

}  // namespace lodesman
