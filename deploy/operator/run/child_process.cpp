// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/run/child_process.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>
#include <thread>

#include "mid_level/base/clock.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

constexpr int kCannotRun = 127;

// In the child, between fork and exec: nothing but system calls.
[[noreturn]] void become(const char* path, char* const* arguments, pid_t parent,
                         int input) noexcept {
  // What the parent does on these signals, or keeps from itself, is not for this copy of it.
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGPIPE, SIGCHLD, SIGXFSZ}) {
    std::signal(signal, SIG_DFL);
  }
  sigset_t none;
  sigemptyset(&none);
  pthread_sigmask(SIG_SETMASK, &none, nullptr);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) {
    _exit(kCannotRun);  // the parent died before the line above
  }
  // An interrupt typed at the terminal reaches the parent, which stops its children in order.
  setpgid(0, 0);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  dup2(input, STDIN_FILENO);
  execv(path, arguments);
  _exit(kCannotRun);
}

[[noreturn]] void refuse_to_start(const std::string& program) {
  throw StartupError(program + " cannot be started: " + std::generic_category().message(errno));
}

}  // namespace

ChildProcess::ChildProcess(const std::string& program, const std::vector<std::string>& arguments)
    : name_{program} {
  std::error_code error;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::string path = (self.parent_path() / program).string();
  if (access(path.c_str(), X_OK) != 0) {
    throw StartupError(path + " cannot be run: " + std::generic_category().message(errno));
  }
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (auto& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  std::array<int, 2> pipe_ends{};
  if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0) {
    refuse_to_start(program);
  }
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) {
    become(path.c_str(), pointers.data(), parent, pipe_ends[0]);
  }
  const int error_number = errno;
  close(pipe_ends[0]);
  life_line_ = pipe_ends[1];
  fcntl(life_line_, F_SETFL, O_NONBLOCK);
  if (pid_ < 0) {
    close(life_line_);
    errno = error_number;
    refuse_to_start(program);
  }
}

ChildProcess::~ChildProcess() {
  stop(std::chrono::seconds{2});
  close(life_line_);
}

const std::optional<std::string>& ChildProcess::ended() {
  int status = 0;
  const pid_t waited = ended_ ? 0 : waitpid(pid_, &status, WNOHANG);
  if (waited == pid_) {
    if (WIFEXITED(status)) {
      exit_status_ = WEXITSTATUS(status);
    }
    ended_ = exit_status_ ? "exit status " + std::to_string(*exit_status_)
                          : "signal " + std::to_string(WTERMSIG(status));
  } else if (waited < 0 && errno == ECHILD) {
    ended_ = "unseen";
  }
  return ended_;
}

void ChildProcess::beat() const noexcept {
  // What cannot be written is a beat that the child does not hear: that is all there is to it.
  static_cast<void>(!write(life_line_, "", 1));
}

void ChildProcess::stop(Duration patience) {
  if (ended()) {
    return;
  }
  kill(pid_, SIGTERM);
  const SteadyClock clock;
  const Time deadline = clock.now() + patience;
  while (!ended() && clock.now() < deadline) {
    std::this_thread::sleep_for(std::chrono::milliseconds{5});
  }
  if (!ended()) {
    kill(pid_, SIGKILL);
    int status = 0;
    while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
    }
    ended_ = "killed";
  }
}

}  // namespace lodesman::cli
