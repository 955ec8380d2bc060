// SPDX-License-Identifier: Apache-2.0
// The console's own topics for its page: when each is due, and when it has changed. Nothing is made
// that nobody listens to, but for events, which are kept. One thread.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/console/board_feed.h"
#include "deploy/operator/console/client.h"
#include "deploy/operator/console/command_port.h"
#include "deploy/operator/console/events.h"
#include "deploy/operator/console/topics.h"
#include "deploy/operator/console/world_json.h"
#include "mid_level/recording/sonar_picture.h"

namespace lodesman::console {

using Clients = std::list<std::shared_ptr<Client>>;

struct OwnOptions {
  Hull hull;
  double min_range_m = 0.0;  // of the sonar
};

class OwnTopics {
 public:
  static constexpr std::size_t kKeptEvents = 50;

  // All must outlive it. `status`: a session of the command socket that may look.
  OwnTopics(const OwnOptions& options, TopicTable& topics, const BoardFeed& feed,
            const Clients& clients, std::unique_ptr<CommandPort> status);
  OwnTopics(const OwnTopics&) = delete;
  OwnTopics& operator=(const OwnTopics&) = delete;
  ~OwnTopics() = default;

  // After the feed has looked.
  void step(Time now);
  // Somebody begins to listen: what comes next is due at once.
  void listener(std::uint16_t topic);
  void tell(const Event& event);

 private:
  struct Paced {
    std::uint16_t topic = 0;
    Duration period{};
    Time due{};
    std::vector<std::uint64_t> shown{};  // what it was made of last
  };

  [[nodiscard]] bool is_due(Paced& paced, Time now) const;
  void step_boat(Time now);
  void step_world(Time now);
  void step_coverage(Time now);
  void step_sonar(Time now);
  void step_status(Time now);
  void step_story(Time now);
  void step_clients(Time now);
  void heard_status(const BoatReply& reply);

  OwnOptions options_;
  TopicTable& topics_;
  const BoardFeed& feed_;
  const Clients& clients_;
  Paced boat_;
  Paced world_;
  Paced coverage_;
  Paced sonar_;
  Paced status_;
  Paced story_;
  Paced who_;
  std::uint16_t events_;
  std::uint64_t event_count_ = 0;
  ChangeWatch changes_;
  SonarPicture drawer_;
  bool awaits_status_ = false;
  std::string told_story_;
  Json commander_;  // as the boat's status has it
  std::string told_clients_;
  Time now_{};
  // Last, so that no answer comes to what is gone.
  std::unique_ptr<CommandPort> status_port_;
};

}  // namespace lodesman::console
