// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/kept_boat.h"

#include <fmt/format.h>

#include <utility>

namespace lodesman::cli {
namespace {

constexpr Duration kStopPatience = std::chrono::seconds{2};

}  // namespace

KeptBoat::KeptBoat(std::vector<std::string> arguments, std::function<void(const std::string&)> say)
    : arguments_{std::move(arguments)}, say_{std::move(say)} {
  arguments_.emplace_back("--stop-with-input");
}

std::optional<std::string> KeptBoat::look(Time now) {
  for (Kept& kept : programs_) {
    if (auto refused = look_at(kept, now)) {
      return refused;
    }
  }
  return std::nullopt;
}

std::optional<std::string> KeptBoat::look_at(Kept& kept, Time now) {
  if (kept.process && kept.process->ended()) {
    const std::string how = *kept.process->ended();
    const Keeper::Event event = Keeper::event_of(kept.process->exit_status());
    kept.process.reset();
    kept.keeper.happen(event, now);
    if (kept.keeper.state() == Keeper::State::kOver) {
      return std::string{kept.name} + " has refused to run: " + how;
    }
    say_(fmt::format("{} ended ({}): started again in {:.1f} s", kept.name, how,
                     to_seconds(kept.keeper.due() - now)));
  }
  if (kept.keeper.is_due(now)) {
    kept.process = std::make_unique<ChildProcess>(kept.name, arguments_);
    kept.keeper.happen(Keeper::Event::kStarted, now);
  }
  return std::nullopt;
}

void KeptBoat::stop(Time now) {
  for (auto kept = programs_.rbegin(); kept != programs_.rend(); ++kept) {
    kept->keeper.happen(Keeper::Event::kStop, now);
    if (kept->process) {
      kept->process->stop(kStopPatience);
      kept->process.reset();
    }
  }
}

}  // namespace lodesman::cli
