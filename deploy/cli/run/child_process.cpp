// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/run/child_process.h"

#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

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
[[noreturn]] void become(const char* path, char* const* arguments, pid_t parent) noexcept {
  // What the parent does on these signals is not for this copy of it to do.
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    std::signal(signal, SIG_DFL);
  }
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) {
    _exit(kCannotRun);  // the parent died before the line above
  }
  // An interrupt typed at the terminal reaches the parent, which stops its children in order.
  setpgid(0, 0);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  execv(path, arguments);
  _exit(kCannotRun);
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
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) {
    throw StartupError(program + " cannot be started: " + std::generic_category().message(errno));
  }
  if (pid_ == 0) {
    become(path.c_str(), pointers.data(), parent);
  }
}

ChildProcess::~ChildProcess() { stop(std::chrono::seconds{2}); }

const std::optional<std::string>& ChildProcess::ended() {
  int status = 0;
  if (!ended_ && waitpid(pid_, &status, WNOHANG) == pid_) {
    ended_ = WIFSIGNALED(status) ? "signal " + std::to_string(WTERMSIG(status))
                                 : "exit status " + std::to_string(WEXITSTATUS(status));
  }
  return ended_;
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
    waitpid(pid_, &status, 0);
    ended_ = "killed";
  }
}

}  // namespace lodesman::cli
