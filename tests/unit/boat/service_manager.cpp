// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/service_manager.h"

#include <array>
#include <cstdlib>
#include <memory>

#include "mid_level/runtime/health_watch.h"
#include "tests/unit/boat/unix_listener.h"

namespace lodesman::testing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr Time kStart{seconds{100}};

class Idle final : public Task {
 public:
  void step(Time /*now*/) noexcept override {}
};

// One task, and a service manager that wants to hear of it once in two seconds.
struct Service {
  UnixListener listener;
  std::unique_ptr<Blackboard> board = std::make_unique<Blackboard>();
  Idle task;
  std::array<TaskEntry, 1> tasks{scheduled(TaskId::kThruster, task)};
  HealthWatch health{*board, tasks, kStart};
  Writer<TaskHealth> word{board->task_health[static_cast<std::size_t>(TaskId::kThruster)],
                          Role::kLow, "thruster"};
  std::string line = "one";

  explicit Service(const char* watchdog_us = "2000000") {
    setenv("NOTIFY_SOCKET", listener.path().c_str(), 1);
    setenv("WATCHDOG_USEC", watchdog_us, 1);
  }
  Service(const Service&) = delete;
  Service& operator=(const Service&) = delete;
  ~Service() {
    unsetenv("NOTIFY_SOCKET");
    unsetenv("WATCHDOG_USEC");
  }
  void look(ServiceManager& manager, Duration after) {
    manager.look(health, kStart + after, [this] { return line; });
  }
  // How many words of life were heard since.
  [[nodiscard]] int lives() const {
    int count = 0;
    for (std::string text = listener.hear(); !text.empty(); text = listener.hear()) {
      count += text == "WATCHDOG=1" ? 1 : 0;
    }
    return count;
  }
};

TEST_CASE("service manager: ready is said once every task has stepped, and not before", "[boat]") {
  Service service;
  ServiceManager manager;
  service.look(manager, milliseconds{10});
  CHECK(service.listener.hear() == "STATUS=one");
  CHECK(service.listener.hear().empty());
  service.word.publish({}, kStart + milliseconds{15});
  service.look(manager, milliseconds{20});
  CHECK(service.listener.hear() == "READY=1");
  CHECK(service.listener.hear() == "WATCHDOG=1");
  service.look(manager, milliseconds{40});
  CHECK(service.listener.hear().empty());
  manager.stopping();
  CHECK(service.listener.hear() == "STOPPING=1");
}

TEST_CASE("service manager: four words of life a period, none while a task hangs", "[boat]") {
  Service service;
  ServiceManager manager;
  service.word.publish({}, kStart + milliseconds{1});
  for (int ms = 0; ms < 2000; ms += 25) {
    service.look(manager, milliseconds{ms});
  }
  CHECK(service.lives() == 4);
  // Its word is overdue by now.
  for (int ms = 4000; ms < 8000; ms += 25) {
    service.look(manager, milliseconds{ms});
  }
  CHECK(service.lives() == 0);
  service.word.publish({}, kStart + seconds{8});
  service.look(manager, milliseconds{8010});
  CHECK(service.lives() == 1);
}

TEST_CASE("service manager: what the program does is told where it is another", "[boat]") {
  Service service;
  ServiceManager manager;
  service.look(manager, milliseconds{0});
  CHECK(service.listener.hear() == "STATUS=one");
  service.look(manager, milliseconds{1500});
  CHECK(service.listener.hear().empty());
  service.line = "two";
  service.look(manager, milliseconds{1600});  // asked once a second
  CHECK(service.listener.hear().empty());
  service.look(manager, milliseconds{2600});
  CHECK(service.listener.hear() == "STATUS=two");
}

TEST_CASE("service manager: who waits without tasks is alive", "[boat]") {
  Service service;
  ServiceManager manager;
  manager.wait(kStart, "waiting for lodesman-low");
  CHECK(service.listener.hear() == "WATCHDOG=1");
  CHECK(service.listener.hear() == "STATUS=waiting for lodesman-low");
  manager.wait(kStart + milliseconds{499}, "waiting for lodesman-low");
  CHECK(service.listener.hear().empty());
  manager.wait(kStart + milliseconds{500}, "waiting for lodesman-low");
  CHECK(service.listener.hear() == "WATCHDOG=1");
}

TEST_CASE("service manager: no word of life is said where none is asked for", "[boat]") {
  Service service{"0"};
  ServiceManager manager;
  service.word.publish({}, kStart + milliseconds{1});
  service.look(manager, milliseconds{10});
  CHECK(service.lives() == 0);
}

}  // namespace
}  // namespace lodesman::testing
