// SPDX-License-Identifier: Apache-2.0
// Aborts from outside: `lodesman abort --host` to a network address of this machine, from the start
// of that program to neutral thrust by the stamps of what was applied. In quiet, and while others
// guess tokens from that same address. Fails where one is not confirmed or takes too long.
//   measure_remote_abort [COUNT]
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <random>
#include <thread>

#include "tests/support/far_client.h"
#include "tests/support/own_address.h"
#include "tests/system/remote_boat.h"

namespace lodesman::testing {
namespace {

constexpr double kBound_s = 2.0;
constexpr int kGuessers = 8;

// Guesses tokens, each in a session of its own, as fast as they are answered.
class Guessers {
 public:
  explicit Guessers(const RemoteBoat& boat) {
    for (int i = 0; i < kGuessers; ++i) {
      threads_.emplace_back([this, host = boat.host(), port = boat.port()] {
        while (!stop_) {
          FarClient guesser{host, port};
          guesses_ += guesser.prove(std::string(64, 'e')) ? 0U : 1U;
        }
      });
    }
  }
  Guessers(const Guessers&) = delete;
  Guessers& operator=(const Guessers&) = delete;
  ~Guessers() {
    stop_ = true;
    for (std::thread& thread : threads_) {
      thread.join();
    }
  }
  [[nodiscard]] std::uint64_t guesses() const noexcept { return guesses_; }

 private:
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> guesses_{0};
  std::vector<std::thread> threads_;
};

[[nodiscard]] bool neutral(const ThrustApplied& thrust) {
  return (thrust.left == 127 || thrust.left == 128) && (thrust.right == 127 || thrust.right == 128);
}

// Nothing where it was not confirmed.
[[nodiscard]] std::optional<double> neutral_after_s(RemoteBoat& boat) {
  const SteadyClock clock;
  const Time sent = clock.now();
  if (boat.tell({"abort"}) != 0) {
    return std::nullopt;
  }
  std::optional<double> after_s;
  const bool found = eventually([&] {
    const auto* applied = boat.thrust().next();
    if (applied != nullptr && applied->stamp >= sent && neutral(applied->value)) {
      after_s = to_seconds(applied->stamp - sent);
    }
    return after_s.has_value();
  });
  return found ? after_s : std::nullopt;
}

// Prints a row; whether all was well.
[[nodiscard]] bool measure(RemoteBoat& boat, const char* name, int count) {
  std::vector<double> times_s;
  std::mt19937 random{1};
  for (int i = 0; i < count; ++i) {
    const bool sails = boat.sails();
    std::this_thread::sleep_for(milliseconds{random() % 100});  // any phase of the tasks
    if (const auto after_s = sails ? neutral_after_s(boat) : std::nullopt) {
      times_s.push_back(*after_s);
    }
  }
  std::sort(times_s.begin(), times_s.end());
  const double median_s = times_s.empty() ? 0.0 : times_s[times_s.size() / 2];
  const double worst_s = times_s.empty() ? 0.0 : times_s.back();
  std::printf("| %s | %d | %zu | %.3f | %.3f |\n", name, count, times_s.size(), median_s, worst_s);
  return times_s.size() == static_cast<std::size_t>(count) && worst_s <= kBound_s;
}

int measure_all(int count) {
  const auto own = own_address(AF_INET);
  if (!own) {
    return EXIT_SUCCESS;  // said
  }
  const Scratch scratch{"measure-remote"};
  RemoteBoat boat{scratch, *own};
  std::printf("| an abort from outside | times | confirmed | median s | worst s |\n");
  std::printf("|---|---|---|---|---|\n");
  bool ok = measure(boat, "in quiet", count);
  const SteadyClock clock;
  const Time begun = clock.now();
  std::uint64_t guesses = 0;
  {
    const Guessers guessers{boat};
    ok &= measure(boat, "while 8 clients at the same address guess", count);
    guesses = guessers.guesses();
  }
  std::printf("guesses answered per s: %.0f\n",
              static_cast<double>(guesses) / to_seconds(clock.now() - begun));
  return ok ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace lodesman::testing

int main(int argc, char** argv) {
  try {
    const int count = argc > 1 ? std::atoi(argv[1]) : 100;
    return count > 0 ? lodesman::testing::measure_all(count) : EXIT_FAILURE;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "measure_remote_abort: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
