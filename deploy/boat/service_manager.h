// SPDX-License-Identifier: Apache-2.0
// What a program tells the service manager that started it (systemd: sd_notify(3)): that it is
// ready, in a line what it does, and that its tasks are alive. Says nothing where nobody asked: a
// bench has no service manager. The main thread.
#pragma once

#include <functional>
#include <string>

#include "mid_level/base/time.h"

namespace lodesman {

class HealthWatch;

class ServiceManager {
 public:
  // Who listens, and how often it wants to hear, stands in the environment.
  ServiceManager();

  // To be called often. Ready once every task steps. From then on a word of life four times in the
  // period that is asked for, as long as no task hangs: a program whose main thread lives and whose
  // tasks do not is started again. `status` is asked once a second, and told where it is another.
  void look(HealthWatch& health, Time now, const std::function<std::string()>& status);
  // Alive, without tasks: it waits for something that is told.
  void wait(Time now, const std::string& status);
  void stopping();

 private:
  enum class Phase : std::uint8_t { kStarting, kReady, kStopping };

  void tell_life(Time now);
  void tell_status(const std::string& status);

  Phase phase_ = Phase::kStarting;
  Duration life_period_{};  // 0: nobody asks
  Time life_due_{};
  Time status_due_{};
  std::string told_;
};

}  // namespace lodesman
