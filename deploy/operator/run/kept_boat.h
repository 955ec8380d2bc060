// SPDX-License-Identifier: Apache-2.0
// The programs of a boat where no service manager keeps them: lodesman-low and lodesman-high,
// started, started again where they end, and stopped in order, the high level first, so that what
// the thrusters are told last is neutral. They end with this process, however that does. The main
// thread.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "deploy/operator/run/child_process.h"
#include "deploy/operator/run/keeper.h"

namespace lodesman::cli {

class KeptBoat {
 public:
  // arguments: of both programs. say: a line for whoever looks on.
  KeptBoat(std::vector<std::string> arguments, std::function<void(const std::string&)> say);

  // Starts what is due and takes note of what has ended; to be called some fifty times a second.
  // Empty as long as all goes on; else the program that has refused to run: then all is over.
  // Throws StartupError where a program cannot be run at all.
  [[nodiscard]] std::optional<std::string> look(Time now);
  // The high level, then the low one.
  void stop(Time now);

  [[nodiscard]] unsigned restarts_of_low() const noexcept { return programs_[0].keeper.restarts(); }
  [[nodiscard]] unsigned restarts_of_high() const noexcept {
    return programs_[1].keeper.restarts();
  }

 private:
  struct Kept {
    const char* name;
    Keeper keeper{};
    std::unique_ptr<ChildProcess> process{};
  };
  [[nodiscard]] std::optional<std::string> look_at(Kept& kept, Time now);

  std::vector<std::string> arguments_;
  std::function<void(const std::string&)> say_;
  std::array<Kept, 2> programs_{{{"lodesman-low"}, {"lodesman-high"}}};
};

}  // namespace lodesman::cli
