// SPDX-License-Identifier: Apache-2.0
// Whose a segment is: one name has one owner, however starts interleave; another user's is nobody's
// here; and what cannot be had in full is refused before it is used.
#include <fcntl.h>
#include <grp.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <optional>
#include <utility>
#include <vector>

#include "mid_level/blackboard/segment.h"
#include "tests/support/catch.h"

using namespace lodesman;

namespace {

// Called once, before the next lock is taken by anyone in this program.
std::function<void()> before_next_lock;

}  // namespace

// In place of the C library's, so that a test can put another start between two system calls.
extern "C" int fcntl(int descriptor, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void* argument = va_arg(arguments, void*);
  va_end(arguments);
  if (command == F_OFD_SETLK && before_next_lock) {
    std::exchange(before_next_lock, nullptr)();
  }
  return static_cast<int>(syscall(SYS_fcntl, descriptor, command, argument));
}

namespace {

constexpr unsigned kNobody = 65534;

std::string own_name_of(const char* test) {
  return "lodesman-test-owner-" + std::string{test} + "-" + std::to_string(getpid());
}

std::string path_of(const std::string& name) { return "/dev/shm/" + name; }

std::optional<struct stat> file_of(const std::string& name) {
  struct stat file {};
  return stat(path_of(name).c_str(), &file) == 0 ? std::optional{file} : std::nullopt;
}

// What a low level that is killed leaves. Not ready: nobody can go on with it.
enum class Left { kNothing, kWhole, kNotReady };

void leave(const std::string& name, Left left) {
  remove_dead_segment(name);
  if (left == Left::kNothing) {
    return;
  }
  const pid_t child = fork();
  if (child == 0) {
    const auto low = SharedBlackboard::create(name);
    kill(getpid(), SIGKILL);
  }
  waitpid(child, nullptr, 0);
  if (left == Left::kNotReady) {
    const int file = open(path_of(name).c_str(), O_RDWR | O_CLOEXEC);
    const std::uint64_t word = 0;
    REQUIRE(pwrite(file, &word, sizeof word, offsetof(SegmentHeader, ready)) == sizeof word);
    close(file);
  }
}

// Processes that all start as the low level once the gate opens, and say how it went: 'o' for an
// owner, who stays alive, 'r' for refused.
class Starters {
 public:
  Starters(const std::string& name, std::size_t count) {
    REQUIRE(pipe(gate_.data()) == 0);
    REQUIRE(pipe(answers_.data()) == 0);
    for (std::size_t i = 0; i < count; ++i) {
      children_.push_back(fork());
      if (children_.back() == 0) {
        start(name);
      }
    }
    close(gate_[0]);
    close(answers_[1]);
  }
  Starters(const Starters&) = delete;
  Starters& operator=(const Starters&) = delete;
  ~Starters() {
    for (const pid_t child : children_) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    close(answers_[0]);
  }
  [[nodiscard]] std::string answers_at_once() {
    close(gate_[1]);
    std::string answers;
    for (char answer = 0;
         answers.size() < children_.size() && read(answers_[0], &answer, 1) == 1;) {
      answers.push_back(answer);
    }
    return answers;
  }

 private:
  [[noreturn]] void start(const std::string& name) const {
    close(gate_[1]);
    char nothing = 0;
    static_cast<void>(!read(gate_[0], &nothing, 1));  // until the gate is closed at its other end
    try {
      const auto low = SharedBlackboard::create(name);
      static_cast<void>(!write(answers_[1], "o", 1));
      for (;;) {
        pause();
      }
    } catch (const StartupError&) {
      static_cast<void>(!write(answers_[1], "r", 1));
      _exit(0);
    }
  }

  std::array<int, 2> gate_{};
  std::array<int, 2> answers_{};
  std::vector<pid_t> children_;
};

// Where this test cannot be made, says why: it counts as skipped, not as passed.
bool is_root_for(const char* what) {
  if (geteuid() != 0) {
    std::cout << "skipped: no rights to " << what << "\n";
  }
  return geteuid() == 0;
}

enum class Room : int { kRefused = 0, kWrong = 1, kNoSuchPlace = 2 };

// In a process of its own, makes /dev/shm a file system of `options` and a segment in it.
Room segment_in_small_memory(const std::string& name, const char* options) {
  const pid_t child = fork();
  if (child == 0) {
    const bool placed = unshare(CLONE_NEWNS) == 0 &&
                        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
                        mount("none", "/dev/shm", "tmpfs", 0, options) == 0;
    if (!placed) {
      _exit(static_cast<int>(Room::kNoSuchPlace));
    }
    try {
      const auto low = SharedBlackboard::create(name);
      std::puts("a segment was made");
    } catch (const StartupError& error) {
      const bool said = std::string{error.what()}.ends_with(": No space left on device");
      std::puts(error.what());
      std::fflush(stdout);
      _exit(static_cast<int>(said && !file_of(name) ? Room::kRefused : Room::kWrong));
    }
    _exit(static_cast<int>(Room::kWrong));
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Room>(WEXITSTATUS(status)) : Room::kWrong;
}

}  // namespace

TEST_CASE("segment: of many low levels that start at once exactly one owns the name",
          "[mid_level][blackboard]") {
  const auto name = own_name_of("many");
  for (std::size_t round = 0; round < 60; ++round) {
    leave(name, std::array{Left::kNothing, Left::kWhole, Left::kNotReady}[round % 3]);
    Starters starters{name, 6};
    const std::string answers = starters.answers_at_once();
    REQUIRE(answers.size() == 6);
    REQUIRE(std::count(answers.begin(), answers.end(), 'o') == 1);
    REQUIRE(SharedBlackboard::observe(name, Duration::zero()).alive(Role::kLow));
  }
  leave(name, Left::kNothing);
}

TEST_CASE("segment: who locks a file that has lost its name meanwhile owns nothing",
          "[mid_level][blackboard]") {
  const auto name = own_name_of("late");
  for (const Left left : {Left::kNotReady, Left::kWhole, Left::kNothing}) {
    leave(name, left);
    std::optional<SharedBlackboard> first;
    // The late one has opened what it found, or made its own file, when the other one starts.
    before_next_lock = [&] { first.emplace(SharedBlackboard::create(name)); };
    CHECK_THROWS_WITH(SharedBlackboard::create(name),
                      "segment " + name + " is in use by a running lodesman-low");
    REQUIRE(first);
    CHECK(SharedBlackboard::observe(name, Duration::zero()).alive(Role::kLow));
    CHECK_FALSE(first->is_superseded());
    first.reset();
    CHECK_FALSE(file_of(name));
  }
}

TEST_CASE("segment: an owner that goes never takes the name of another file with it",
          "[mid_level][blackboard]") {
  const auto name = own_name_of("name");
  std::optional first{SharedBlackboard::create(name)};
  REQUIRE(shm_unlink(name.c_str()) == 0);  // as a person might, by hand
  const auto second = SharedBlackboard::create(name);
  first.reset();
  CHECK(file_of(name));
}

TEST_CASE("segment: it is its user's alone, whatever the umask", "[mid_level][blackboard]") {
  const auto name = own_name_of("mode");
  for (const mode_t mask : {0U, 0777U}) {
    const mode_t usual = umask(mask);
    {
      const auto low = SharedBlackboard::create(name);
      CHECK((file_of(name)->st_mode & 0777U) == 0600U);
    }
    umask(usual);
  }
  leave(name, Left::kWhole);
  REQUIRE(chmod(path_of(name).c_str(), 0666) == 0);
  const auto low = SharedBlackboard::create(name);
  CHECK((file_of(name)->st_mode & 0777U) == 0600U);
}

TEST_CASE("segment: another user's is refused by all and stays as it is",
          "[mid_level][blackboard]") {
  if (!is_root_for("make another user's segment")) {
    return;
  }
  const auto name = own_name_of("user");
  leave(name, Left::kWhole);
  REQUIRE(chown(path_of(name).c_str(), kNobody, kNobody) == 0);
  const auto before = file_of(name);
  const std::string refusal = "segment " + name + " belongs to another user (65534)";
  CHECK_THROWS_WITH(SharedBlackboard::create(name), refusal);
  CHECK_THROWS_WITH(SharedBlackboard::open(name, Role::kHigh, Duration::zero()), refusal);
  CHECK_THROWS_WITH(SharedBlackboard::observe(name, Duration::zero()), refusal);
  CHECK_FALSE(remove_dead_segment(name));
  REQUIRE(file_of(name));
  CHECK(file_of(name)->st_ino == before->st_ino);
  REQUIRE(shm_unlink(name.c_str()) == 0);
}

TEST_CASE("segment: another user can neither read it nor seem to be alive on it",
          "[mid_level][blackboard]") {
  if (!is_root_for("become another user")) {
    return;
  }
  const auto name = own_name_of("stranger");
  const auto low = SharedBlackboard::create(name);
  const pid_t child = fork();
  if (child == 0) {
    const bool stranger =
        setgroups(0, nullptr) == 0 && setgid(kNobody) == 0 && setuid(kNobody) == 0;
    try {
      const auto board = SharedBlackboard::observe(name, Duration::zero());
      _exit(1);
    } catch (const StartupError& error) {
      _exit(stranger && std::string{error.what()} ==
                            "segment " + name + " cannot be opened: Permission denied"
                ? 0
                : 2);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
}

TEST_CASE("segment: without room for all of it nothing is made and nothing is left",
          "[mid_level][blackboard]") {
  const auto name = own_name_of("room");
  for (const char* options : {"size=16k", "size=1m"}) {
    const Room room = segment_in_small_memory(name, options);
    if (room == Room::kNoSuchPlace) {
      std::cout << "skipped: no rights to mount a small /dev/shm\n";
      return;
    }
    CHECK(room == Room::kRefused);
  }
}

TEST_CASE("segment: a limit on the size of files is a refusal that leaves nothing",
          "[mid_level][blackboard]") {
  const auto name = own_name_of("limit");
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{65536, 65536};
    setrlimit(RLIMIT_FSIZE, &limit);
    try {
      const auto low = SharedBlackboard::create(name);
      _exit(1);
    } catch (const StartupError&) {
      _exit(0);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK_FALSE(file_of(name));
}
