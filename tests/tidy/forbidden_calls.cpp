// SPDX-License-Identifier: Apache-2.0
// Compiled as a room is: calls what rooms must not, so that the test of their symbols can be seen
// to find it. Nobody runs this.
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <mutex>
#include <random>
#include <string>
#include <thread>

namespace lodesman::tidy {

long forbidden_clock() { return std::chrono::steady_clock::now().time_since_epoch().count(); }

void forbidden_sleep() {
  const timespec moment{0, 1};
  nanosleep(&moment, nullptr);
}

long forbidden_wait(int* word) { return syscall(SYS_futex, word, FUTEX_WAIT, 0, nullptr); }

void forbidden_lock(std::mutex& mutex, std::condition_variable& changed) {
  const std::lock_guard lock{mutex};
  changed.notify_all();
}

void forbidden_thread() {
  std::thread{[] {}}.detach();
}

void forbidden_log(int number) { std::printf("%d\n", number); }

int (*forbidden_chance())() { return &std::rand; }

unsigned forbidden_device() { return std::random_device{}(); }

int* forbidden_allocation() { return new int{1}; }

void forbidden_growth(std::string& text) { text.append("more"); }

}  // namespace lodesman::tidy
