// SPDX-License-Identifier: Apache-2.0
#include "drivers/stream/reconnecting_line.h"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <system_error>
#include <utility>

#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace {

// After bytes were told of, before they are again: the task is on its way to them.
constexpr Duration kAfterBytes = std::chrono::milliseconds{1};
// The same of a hang-up, which does not go away by being read.
constexpr Duration kAfterHangUp = std::chrono::milliseconds{100};

[[nodiscard]] timespec to_timespec(Duration duration) noexcept {
  const auto seconds = std::chrono::floor<std::chrono::seconds>(duration);
  return {seconds.count(), (duration - seconds).count()};
}

void silence(int bell) noexcept {
  eventfd_t rings = 0;
  static_cast<void>(eventfd_read(bell, &rings));
}

// Signals are for threads that expect them: the helper is begun with all of them blocked.
class SignalsBlocked {
 public:
  SignalsBlocked() noexcept {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before_);
  }
  SignalsBlocked(const SignalsBlocked&) = delete;
  SignalsBlocked& operator=(const SignalsBlocked&) = delete;
  ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

 private:
  sigset_t before_{};
};

}  // namespace

ReconnectingLine::ReconnectingLine(std::string path, int baud, PortOpener open_port,
                                   std::function<void()> on_bytes)
    : path_{std::move(path)},
      open_port_{std::move(open_port)},
      on_bytes_{std::move(on_bytes)},
      bell_{eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)},
      word_{Word{Hold::kAbsent, baud}} {
  if (!bell_.is_open()) {
    throw StartupError("no descriptor is left for " + path_);
  }
  const SignalsBlocked blocked;
  try {
    helper_ = std::thread{[this] { help(); }};
  } catch (const std::system_error&) {
    throw StartupError("no thread is left for " + path_);
  }
}

ReconnectingLine::~ReconnectingLine() {
  stopping_.store(true, std::memory_order_release);
  ring();
  helper_.join();
}

bool ReconnectingLine::is_opened() const noexcept {
  return word_.load(std::memory_order_acquire).hold == Hold::kOpened;
}

void ReconnectingLine::ring() noexcept { static_cast<void>(eventfd_write(bell_.value(), 1)); }

void ReconnectingLine::give_up(DeviceFault why) noexcept {
  fault_.store(why, std::memory_order_relaxed);
  full_since_.reset();
  const std::int32_t baud = word_.load(std::memory_order_relaxed).baud;
  word_.store({Hold::kGivenUp, baud}, std::memory_order_release);
  ring();
}

std::uint64_t ReconnectingLine::connection(Time /*now*/) noexcept {
  return is_opened() ? connections_ : 0;
}

Received ReconnectingLine::read(std::span<std::uint8_t> into, Time now) noexcept {
  if (into.empty() || !is_opened()) {
    return {0, now};
  }
  const std::size_t count = port_->read(into);
  if (count == 0 && port_->is_gone()) {
    give_up(DeviceFault::kUnplugged);
  }
  return {count, now};
}

std::size_t ReconnectingLine::write(std::span<const std::uint8_t> bytes, Time now) noexcept {
  if (bytes.empty() || !is_opened()) {
    return 0;
  }
  const std::size_t taken = port_->write(bytes);
  if (taken > 0) {
    full_since_.reset();
  } else if (port_->is_gone()) {
    give_up(DeviceFault::kUnplugged);
  } else if (!full_since_) {
    full_since_ = now;
  } else if (now - *full_since_ >= kFullLimit) {
    give_up(DeviceFault::kLineFull);
  }
  return taken;
}

// The helper may move the word meanwhile, twice at most until it needs the task to go on.
void ReconnectingLine::reconnect(int baud) noexcept {
  Word old = word_.load(std::memory_order_acquire);
  Word wanted;
  do {
    if (old.hold == Hold::kOpened) {
      full_since_.reset();
      fault_.store(DeviceFault::kNone, std::memory_order_relaxed);
    }
    wanted = {old.hold == Hold::kOpened ? Hold::kGivenUp : old.hold, baud};
  } while (!word_.compare_exchange_weak(old, wanted, std::memory_order_acq_rel,
                                        std::memory_order_acquire));
  ring();
}

DeviceFault ReconnectingLine::fault() const noexcept {
  return is_opened() ? DeviceFault::kNone : fault_.load(std::memory_order_relaxed);
}

void ReconnectingLine::help() noexcept {
  pthread_setname_np(pthread_self(), "line");
  while (!stopping_.load(std::memory_order_acquire)) {
    switch (word_.load(std::memory_order_acquire).hold) {
      case Hold::kAbsent: connect(); break;
      case Hold::kOpened: attend(); break;
      case Hold::kGivenUp: disconnect(); break;
    }
  }
  port_.reset();
}

void ReconnectingLine::connect() {
  Word absent = word_.load(std::memory_order_acquire);
  OpenedPort opened = open_port_(path_, absent.baud);
  if (!opened.port) {
    const bool went = opened.fault == DeviceFault::kNoPort && connections_ > 0;
    fault_.store(went ? DeviceFault::kUnplugged : opened.fault, std::memory_order_relaxed);
    wait(pause_);
    lengthen_pause();
    return;
  }
  port_ = std::move(opened.port);
  ++connections_;
  power_up_ = opened.power_up;
  opened_at_ = SteadyClock{}.now();
  if (!word_.compare_exchange_strong(absent, {Hold::kOpened, absent.baud},
                                     std::memory_order_acq_rel, std::memory_order_acquire)) {
    port_.reset();  // another speed is wanted by now
    --connections_;
  } else if (on_bytes_) {
    on_bytes_();  // that there is a connection is news too
  }
}

void ReconnectingLine::attend() noexcept {
  std::array<pollfd, 2> waited{pollfd{bell_.value(), POLLIN, 0},
                               pollfd{port_->descriptor(), POLLIN, 0}};
  // Without anybody to tell, the port is the task's alone to look at.
  ppoll(waited.data(), on_bytes_ ? 2 : 1, nullptr, nullptr);
  if ((waited[0].revents & POLLIN) != 0) {
    silence(bell_.value());
  } else if (waited[1].revents != 0) {
    on_bytes_();
    wait((waited[1].revents & ~POLLIN) == 0 ? kAfterBytes : kAfterHangUp);
  }
}

void ReconnectingLine::disconnect() noexcept {
  port_.reset();
  // Nothing ails a port that was given up for another speed: that is not to wait for a pause.
  const bool at_once = fault_.load(std::memory_order_relaxed) == DeviceFault::kNone;
  Word given_up = word_.load(std::memory_order_acquire);
  while (!word_.compare_exchange_weak(given_up, {Hold::kAbsent, given_up.baud},
                                      std::memory_order_acq_rel, std::memory_order_acquire)) {
  }
  if (SteadyClock{}.now() - opened_at_ >= kLongestPause) {
    pause_ = kFirstPause;
  }
  if (!at_once) {
    wait(pause_);
    lengthen_pause();
  }
}

// Until the bell rings, or for so long.
void ReconnectingLine::wait(Duration at_most) noexcept {
  pollfd waited{bell_.value(), POLLIN, 0};
  const timespec limit = to_timespec(at_most);
  if (ppoll(&waited, 1, &limit, nullptr) > 0) {
    silence(bell_.value());
  }
}

void ReconnectingLine::lengthen_pause() noexcept { pause_ = std::min(2 * pause_, kLongestPause); }

}  // namespace lodesman
