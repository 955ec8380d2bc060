// SPDX-License-Identifier: Apache-2.0
// The console without its sockets: what it answers to HTTP, who its viewers are, and what it
// publishes to them of the boat, all when it is told the time. One thread.
#pragma once

#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/console/board_feed.h"
#include "deploy/operator/console/client.h"
#include "deploy/operator/console/command_port.h"
#include "deploy/operator/console/http_rules.h"
#include "deploy/operator/console/own_topics.h"
#include "deploy/operator/console/pulse.h"
#include "deploy/operator/console/sessions.h"
#include "deploy/operator/console/static_files.h"
#include "deploy/operator/console/token_book.h"

namespace lodesman::console {

struct ConsoleOptions {
  std::string boat;
  std::string segment;
  std::uint16_t command_port = 0;
  std::string lasting_tokens;      // a file; empty: none
  std::vector<std::string> names;  // allowed in Host, beside loopback's
  Hull hull;
  double min_range_m = 0.0;  // of the sonar
  std::filesystem::path page;
};

class Console {
 public:
  static constexpr std::size_t kMaxClients = 64;
  static constexpr Duration kLookPeriod = std::chrono::milliseconds{20};

  Console(ConsoleOptions options, PortMaker make_port);
  Console(const Console&) = delete;
  Console& operator=(const Console&) = delete;
  ~Console();

  [[nodiscard]] HttpReply answer(const HttpRequest& request, Time now);
  // Of a request to speak the viewers' protocol: what it may, or why not.
  struct Admission {
    std::optional<ClientRights> rights;
    HttpReply refusal;
  };
  [[nodiscard]] Admission admit(const HttpRequest& request, Time now);
  // Which has been greeted; nullptr where there is no place.
  [[nodiscard]] std::shared_ptr<Client> add_client(const ClientRights& rights);
  void remove_client(Client& client);
  [[nodiscard]] std::size_t client_count() const noexcept { return clients_.size(); }

  // Every kLookPeriod.
  void step(Time now);

  // For who starts it: signs in once, to command.
  [[nodiscard]] std::string make_one_time_token() { return sessions_.make_one_time_token(); }

 private:
  [[nodiscard]] std::optional<HttpReply> refusal_of(const HttpRequest& request,
                                                    bool any_origin) const;
  [[nodiscard]] const Session* session_of(const HttpRequest& request, Time now);
  [[nodiscard]] HttpReply answer_session(const HttpRequest& request, Time now);
  [[nodiscard]] HttpReply sign_in(const HttpRequest& request, Time now);
  [[nodiscard]] HttpReply sign_out(const HttpRequest& request, Time now);
  [[nodiscard]] HttpReply answer_ticket(const HttpRequest& request, Time now);
  [[nodiscard]] std::string token_of(std::uint64_t session) const;
  void end_orphans();

  ConsoleOptions options_;
  PortMaker make_port_;
  std::string id_;
  TopicTable topics_;
  TokenBook tokens_;
  Sessions sessions_;
  StaticFiles files_;
  BoardFeed feed_;
  Pulse pulse_;
  std::list<std::shared_ptr<Client>> clients_;
  std::uint64_t last_client_ = 0;
  OwnTopics own_;
};

}  // namespace lodesman::console
