// SPDX-License-Identifier: Apache-2.0
#include "deploy/boat/stop_signals.h"

#include <poll.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <csignal>

#include "mid_level/base/clock.h"

namespace lodesman {
namespace {

constexpr int kGiveUpPeriod_ms = 25;
constexpr Duration kLongestSilence = std::chrono::milliseconds{250};

bool g_stop_with_input = false;
Time g_last_beat{};  // none yet
volatile std::sig_atomic_t g_stop_caught = 0;

void set_handler(int signal, void (*handler)(int)) noexcept {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: a stop interrupts a call that waits
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

// Only nohup ignores a hang-up, and it means it.
[[nodiscard]] bool hangup_is_ignored() noexcept {
  struct sigaction action {};
  return sigaction(SIGHUP, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

[[nodiscard]] const sigset_t& stop_signals() noexcept {
  static const sigset_t kSignals = [] {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    if (!hangup_is_ignored()) {
      sigaddset(&set, SIGHUP);
    }
    return set;
  }();
  return kSignals;
}

void handle_stop_signals(void (*handler)(int)) noexcept {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (sigismember(&stop_signals(), signal) == 1) {
      set_handler(signal, handler);
    }
  }
}

// Takes the launcher's beats; false at their end.
[[nodiscard]] bool take_beats() noexcept {
  std::array<char, 4096> beats{};
  const ssize_t taken = read(STDIN_FILENO, beats.data(), beats.size());
  if (taken > 0) {
    g_last_beat = SteadyClock{}.now();
  }
  return taken > 0;
}

// A blocked signal that has come stays pending, so this goes on being true.
[[nodiscard]] bool stop_asked_within(int milliseconds) noexcept {
  static const int kSignalsFile = signalfd(-1, &stop_signals(), SFD_CLOEXEC | SFD_NONBLOCK);
  std::array<pollfd, 2> watched{
      {{kSignalsFile, POLLIN, 0}, {g_stop_with_input ? STDIN_FILENO : -1, POLLIN, 0}}};
  poll(watched.data(), watched.size(), milliseconds);
  if (watched[1].revents != 0 && !((watched[1].revents & POLLIN) != 0 && take_beats())) {
    return true;
  }
  sigset_t pending;
  sigpending(&pending);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    if (sigismember(&stop_signals(), signal) == 1 && sigismember(&pending, signal) == 1) {
      return true;
    }
  }
  return false;
}

}  // namespace

void settle_signals() noexcept {
  set_handler(SIGPIPE, SIG_IGN);
  set_handler(SIGXFSZ, SIG_IGN);
  set_handler(SIGCHLD, SIG_DFL);
}

void block_stop_signals() noexcept {
  handle_stop_signals(SIG_DFL);
  pthread_sigmask(SIG_SETMASK, &stop_signals(), nullptr);
}

void stop_with_standard_input() noexcept { g_stop_with_input = true; }

bool launcher_is_silent() noexcept {
  return g_last_beat != Time{} && SteadyClock{}.now() - g_last_beat > kLongestSilence;
}

bool stop_asked() noexcept { return stop_asked_within(0); }

void wait_for_stop(const std::function<bool()>& give_up) {
  while (!stop_asked_within(kGiveUpPeriod_ms) && !give_up()) {
  }
}

void unblock_signals() noexcept {
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

void catch_stop_signals() noexcept {
  handle_stop_signals([](int) { g_stop_caught = 1; });
}

bool stop_caught() noexcept { return g_stop_caught != 0; }

}  // namespace lodesman
