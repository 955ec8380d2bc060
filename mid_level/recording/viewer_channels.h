// SPDX-License-Identifier: Apache-2.0
// What of a recording is for people's eyes, beside the raw messages and made from them: transforms,
// scene, waypoints, position, log and sonar picture, in the shapes that viewers know. Nothing that
// is computed goes by it. One thread; it allocates.
#pragma once

#include <memory>
#include <span>

#include "mid_level/recording/board_tap.h"
#include "mid_level/recording/viewer_sink.h"

namespace lodesman {

class ViewerChannels {
 public:
  // Adds its topics. `sink` must outlive it.
  explicit ViewerChannels(ViewerSink& sink);
  ViewerChannels(const ViewerChannels&) = delete;
  ViewerChannels& operator=(const ViewerChannels&) = delete;
  ~ViewerChannels();

  void take(const Publication& publication, std::span<const std::byte> raw);
  // What comes next is another boat's: what is said once of each is said again.
  void begin_anew();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lodesman
