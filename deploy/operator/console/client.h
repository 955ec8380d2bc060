// SPDX-License-Identifier: Apache-2.0
// One viewer: what it listens to, what it has still to take, and what it commands. What waits for
// it is bounded: of a topic's parts the newest alone, of replies a number, over which it is at its
// end. Nothing here waits for it. The console's thread.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "deploy/operator/console/command_port.h"
#include "deploy/operator/console/foxglove.h"
#include "deploy/operator/console/json_values.h"
#include "deploy/operator/console/pulse.h"
#include "deploy/operator/console/topics.h"
#include "high_level/mission/command_line.h"

namespace lodesman::console {

// So many a second, and no more at once.
class RateLimit {
 public:
  explicit RateLimit(double per_second) noexcept : per_second_{per_second}, left_{per_second} {}
  [[nodiscard]] bool allows(Time now) noexcept;

 private:
  double per_second_;
  double left_;
  Time counted_{};
};

struct Frame {
  bool is_text = false;
  std::string head;
  MessagePtr body;  // behind the head, where there is one
};

struct ClientRights {
  Scope scope = Scope::kView;
  std::uint64_t session = 0;  // 0: by a ticket
  bool may_ask = false;       // of the command socket, whatever its scope is good for
};

// What became of a command, for whoever keeps the story.
struct CommandNews {
  std::string who;
  std::string command;
  Json request;
  BoatReply reply;
};

class Client {
 public:
  static constexpr std::size_t kMaxReplies = 256;
  static constexpr std::size_t kMaxSubscriptions = 128;
  static constexpr std::size_t kMaxCalls = 32;  // under way
  static constexpr double kCommandsPerSecond = 50.0;
  static constexpr double kTextsPerSecond = 200.0;

  // `topics` and `pulse` must outlive it.
  Client(std::uint64_t number, const ClientRights& rights, TopicTable& topics, const Pulse& pulse);
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client();

  // For words that stop the boat there is a session of their own, so that nothing is before them.
  void set_ports(std::unique_ptr<CommandPort> port, std::unique_ptr<CommandPort> urgent);
  // Is called when there is something to take, or it is over.
  std::function<void()> on_work;
  std::function<void(const CommandNews& news)> on_command;
  // A topic was subscribed to that no message is kept of.
  std::function<void(std::uint16_t topic)> on_listener;

  // The first words to it.
  void greet(const std::string& boat, const std::string& console);
  void hear(bool is_text, std::string_view bytes, Time now);
  void offer(std::uint16_t topic, const std::string& part, const MessagePtr& message);
  // What to send next; nothing where it has all.
  [[nodiscard]] std::optional<Frame> take();
  // From now on it is to be closed.
  void end();
  // It is no viewer any more: it listens to nothing and calls nobody, whoever still holds it.
  void leave();

  [[nodiscard]] bool is_over() const noexcept { return is_over_; }
  [[nodiscard]] bool listens_to(std::uint16_t topic) const;
  [[nodiscard]] const ClientRights& rights() const noexcept { return rights_; }
  [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  struct Subscription {
    std::uint16_t topic = 0;
    NewestParts waiting;
  };

  void reply(Frame frame);
  void hear_text(std::string_view bytes, Time now);
  void hear_call(const foxglove::ServiceCall& call, Time now);
  void subscribe(std::uint32_t id, std::uint32_t channel);
  void unsubscribe(std::uint32_t id);
  void fail(const foxglove::ServiceCall& call, const std::string& why);
  void answered(std::uint32_t service, std::uint32_t call, const BoatReply& reply,
                const Json& request);
  void wake() const;

  std::uint64_t number_;
  ClientRights rights_;
  TopicTable& topics_;
  const Pulse& pulse_;
  std::string name_;
  std::deque<Frame> replies_;
  std::map<std::uint32_t, Subscription> subscriptions_;
  std::uint32_t last_served_ = 0;
  RateLimit commands_{kCommandsPerSecond};
  RateLimit texts_{kTextsPerSecond};
  std::size_t calls_ = 0;
  bool is_over_ = false;
  // Last, so that no answer comes to what is gone.
  std::unique_ptr<CommandPort> port_;
  std::unique_ptr<CommandPort> urgent_;
};

}  // namespace lodesman::console
