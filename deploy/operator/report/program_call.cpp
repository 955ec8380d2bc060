// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/program_call.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

// The last of what a program says that is looked at.
constexpr off_t kSaid_bytes = 4096;

// A file in memory. Where a pipe stood, a program that ends before it has read all of it would send
// SIGPIPE, and one that says more than a pipe holds would wait for ever.
class MemoryFile {
 public:
  explicit MemoryFile(std::string_view text) : descriptor_{memfd_create("program", MFD_CLOEXEC)} {
    while (!text.empty()) {
      const ssize_t count = ::write(descriptor_, text.data(), text.size());
      if (count < 0) {
        throw StartupError("no memory for a file: " + std::generic_category().message(errno));
      }
      text.remove_prefix(static_cast<std::size_t>(count));
    }
    lseek(descriptor_, 0, SEEK_SET);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile() { ::close(descriptor_); }

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

  [[nodiscard]] std::string tail() const {
    const off_t size = lseek(descriptor_, 0, SEEK_END);
    std::string text(static_cast<std::size_t>(std::clamp<off_t>(size, 0, kSaid_bytes)), '\0');
    const ssize_t count =
        pread(descriptor_, text.data(), text.size(), std::max<off_t>(0, size - kSaid_bytes));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, count)));
    return text;
  }

 private:
  int descriptor_;
};

// Outside a UTF-8 locale, as on a bare system, a degree sign is two odd bytes to a program.
[[nodiscard]] std::vector<std::string> utf8_environment() {
  std::vector<std::string> variables{"LC_ALL=C.UTF-8"};
  for (char** variable = environ; *variable != nullptr; ++variable) {
    if (!std::string_view{*variable}.starts_with("LC_ALL=")) {
      variables.emplace_back(*variable);
    }
  }
  return variables;
}

[[nodiscard]] std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  return pointers;
}

// 0, or the error's number: posix_spawn tells of a program that cannot be run.
[[nodiscard]] int start(const ProgramCall& call, int input, int said, pid_t& child) {
  std::vector<std::string> words = call.words;
  std::vector<std::string> variables = utf8_environment();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, call.output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, said, STDERR_FILENO);
  posix_spawn_file_actions_addchdir_np(&actions, call.directory.c_str());
  const int error_number = posix_spawnp(&child, words.front().c_str(), &actions, nullptr,
                                        pointers_to(words).data(), pointers_to(variables).data());
  posix_spawn_file_actions_destroy(&actions);
  return error_number;
}

[[nodiscard]] std::string last_line(std::string text) {
  const auto end = text.find_last_not_of(" \r\n\t");
  text.resize(end == std::string::npos ? 0 : end + 1);
  text.erase(0, text.rfind('\n') + 1);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }, ' ');
  return text;
}

[[nodiscard]] std::string how(int status) {
  return WIFEXITED(status) ? "exit status " + std::to_string(WEXITSTATUS(status))
                           : "signal " + std::to_string(WTERMSIG(status));
}

}  // namespace

ProgramResult run_program(const ProgramCall& call) {
  const MemoryFile input{call.input};
  const MemoryFile said{""};
  pid_t child = -1;
  if (const int failed = start(call, input.descriptor(), said.descriptor(), child); failed != 0) {
    return {failed == ENOENT ? ProgramEnd::kMissing : ProgramEnd::kFailure,
            std::generic_category().message(failed)};
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) {
      return {ProgramEnd::kFailure, std::generic_category().message(errno)};
    }
  }
  const bool succeeded = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  std::string reason = last_line(said.tail());
  if (reason.empty() && !succeeded) {
    reason = how(status);
  }
  return {succeeded ? ProgramEnd::kSuccess : ProgramEnd::kFailure, reason};
}

}  // namespace lodesman::cli
