// SPDX-License-Identifier: Apache-2.0
// What happened, one after the other: changes of the boat's state, and what was ordered by whom and
// what became of it. The last ones are kept. One thread.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/console/board_picture.h"
#include "deploy/operator/console/client.h"
#include "deploy/operator/console/story.h"

namespace lodesman::console {

struct Event {
  std::string text;
  Severity severity = Severity::kInfo;
  std::string who;  // empty: the boat itself
};

// What an order and its answer come to; nothing of what is not worth a line: heartbeats, the stick,
// what only looks.
[[nodiscard]] std::optional<Event> event_of(const CommandNews& news);

[[nodiscard]] viewer::Json event_json(const Event& event, Time at, const std::string& utc);
[[nodiscard]] viewer::Shape event_shape();

// Sees what has changed from one picture to the next.
class ChangeWatch {
 public:
  [[nodiscard]] std::vector<Event> look(const BoardPicture& picture, bool is_attached);

 private:
  void say(std::vector<Event>& events, const std::string& what, const std::string& state,
           Severity severity);

  std::map<std::string, std::string> said_;
  bool began_ = false;
};

}  // namespace lodesman::console
