// SPDX-License-Identifier: Apache-2.0
// A session of the boat's command socket for one of the console's viewers: opened when something is
// asked for, with a token that is proved and never shown, and once more when the boat has ended it
// meanwhile. The thread that runs its io_context.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>  // Boost 1.74 uses std::exchange without including it

#include <boost/asio/io_context.hpp>

#include "deploy/operator/console/command_port.h"

namespace lodesman::console {

struct RelayOptions {
  std::string address;  // IP, where the boat listens
  std::uint16_t port = 0;
  Insistence insistence = Insistence::kOnce;
};

class CommandRelay final : public CommandPort {
 public:
  // What the boat may take for an answer, its connection included.
  static constexpr Duration kPatience = std::chrono::seconds{5};
  static constexpr std::size_t kMaxWaiting = 64;

  // `context` must outlive it.
  CommandRelay(boost::asio::io_context& context, const RelayOptions& options, TokenOf token);
  CommandRelay(const CommandRelay&) = delete;
  CommandRelay& operator=(const CommandRelay&) = delete;
  ~CommandRelay() override;

  void ask(const std::string& request, Done done) override;

 private:
  class Link;
  std::shared_ptr<Link> link_;
};

}  // namespace lodesman::console
