// SPDX-License-Identifier: Apache-2.0
// Makes one thread of a living process hang, as a driver does whose call never comes back: it is
// held by ptrace (man 2 ptrace: a thread that is seized and interrupted stops alone) until the
// process is ended by somebody else. Says "hangs" once it does; status 0 once the thread is no
// more.
//   hang_task PROCESS TASK
#include <sys/ptrace.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

// 0: it has no such thread.
[[nodiscard]] pid_t thread_of(const std::string& process, const std::string& task) {
  for (const auto& entry : std::filesystem::directory_iterator{"/proc/" + process + "/task"}) {
    std::string name;
    std::ifstream{entry.path() / "comm"} >> name;
    if (name == task) {
      return std::atoi(entry.path().filename().c_str());
    }
  }
  return 0;
}

// Whatever it stops for, it is not told to go on.
[[nodiscard]] int hold(pid_t thread) {
  int status = 0;
  bool told = false;
  while (waitpid(thread, &status, __WALL) == thread) {
    if (WIFEXITED(status) || WIFSIGNALED(status)) {
      return told ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (!told) {
      std::puts("hangs");
      std::fflush(stdout);
      told = true;
    }
  }
  return EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::fputs("hang_task PROCESS TASK\n", stderr);
    return EXIT_FAILURE;
  }
  const pid_t thread = thread_of(argv[1], argv[2]);
  if (thread == 0 || ptrace(PTRACE_SEIZE, thread, nullptr, nullptr) != 0 ||
      ptrace(PTRACE_INTERRUPT, thread, nullptr, nullptr) != 0) {
    std::perror("hang_task");
    return EXIT_FAILURE;
  }
  return hold(thread);
} catch (const std::exception& error) {
  std::fprintf(stderr, "hang_task: %s\n", error.what());
  return EXIT_FAILURE;
}
