// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/rt_test/companion.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

constexpr int kCannotRun = 127;
constexpr Duration kLook = std::chrono::milliseconds{5};
constexpr Duration kLastPatience = std::chrono::seconds{2};

// In the child, between fork and exec: nothing but system calls.
[[noreturn]] void become(char* const* words, const char* directory, const char* said,
                         pid_t parent) noexcept {
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGCHLD, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  setpgid(0, 0);
  const int output = open(said, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  const int input = open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (getppid() != parent || output < 0 || input < 0 || chdir(directory) != 0) {
    _exit(kCannotRun);
  }
  dup2(input, STDIN_FILENO);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  execv(words[0], words);
  _exit(kCannotRun);
}

}  // namespace

fs::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody writes it
  std::istringstream folders{path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin"};
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (fs::path program = fs::path{folder} / name; access(program.c_str(), X_OK) == 0) {
      return program;
    }
  }
  return {};
}

Companion::Companion(const std::vector<std::string>& words, const fs::path& directory) {
  const fs::path program = find_program(words.front());
  if (program.empty()) {
    throw StartupError(words.front() + " is not installed");
  }
  said_ = directory / (words.front() + ".said");
  std::vector<std::string> copies{words};
  copies.front() = program.string();
  std::vector<char*> pointers;
  pointers.reserve(copies.size() + 1);
  for (std::string& word : copies) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    become(pointers.data(), directory.c_str(), said_.c_str(), parent);
  }
  if (pid_ < 0) {
    throw StartupError(words.front() +
                       " cannot be started: " + std::generic_category().message(errno));
  }
  setpgid(pid_, pid_);  // whoever of the two is first
}

Companion::~Companion() { stop(kLastPatience); }

bool Companion::ended() {
  waited_for_ = waited_for_ || waitpid(pid_, nullptr, WNOHANG) != 0;
  return waited_for_;
}

void Companion::stop(Duration patience) {
  if (ended()) {
    kill(-pid_, SIGKILL);  // what it may have left
    return;
  }
  kill(-pid_, SIGTERM);
  const SteadyClock clock;
  const Time deadline = clock.now() + patience;
  while (!ended() && clock.now() < deadline) {
    std::this_thread::sleep_for(kLook);
  }
  kill(-pid_, SIGKILL);
  while (!waited_for_ && waitpid(pid_, nullptr, 0) < 0 && errno == EINTR) {
  }
  waited_for_ = true;
}

std::string Companion::last_words() const {
  std::ifstream said{said_};
  std::string line;
  std::string last;
  while (std::getline(said, line)) {
    last = line.empty() ? last : line;
  }
  return last;
}

}  // namespace lodesman::cli
