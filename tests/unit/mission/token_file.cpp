// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/token_file.h"

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <set>

#include "mid_level/base/startup_error.h"
#include "tests/support/catch.h"

using namespace lodesman;
namespace fs = std::filesystem;

namespace {

constexpr std::uint16_t kPort = 61234;  // a name: nobody listens

// A directory of its own, first among those in which tokens lie.
class Place {
 public:
  Place() {
    std::string pattern = (fs::temp_directory_path() / "lodesman-token-XXXXXX").string();
    REQUIRE(mkdtemp(pattern.data()) != nullptr);
    path_ = pattern;
    setenv("RUNTIME_DIRECTORY", path_.c_str(), 1);
  }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  ~Place() {
    unsetenv("RUNTIME_DIRECTORY");
    fs::remove_all(path_);
  }
  [[nodiscard]] const fs::path& path() const { return path_; }
  [[nodiscard]] fs::path file(const std::string& name, const std::string& text, mode_t mode) const {
    std::ofstream{path_ / name} << text;
    REQUIRE(chmod((path_ / name).c_str(), mode) == 0);
    return path_ / name;
  }

 private:
  fs::path path_;
};

mode_t mode_of(const fs::path& path) {
  struct stat status {};
  REQUIRE(stat(path.c_str(), &status) == 0);
  return status.st_mode & 07777U;
}

}  // namespace

TEST_CASE("token file: tokens are random", "[high_level][mission]") {
  std::set<std::string> tokens;
  for (int i = 0; i < 1000; ++i) {
    const CommandTokens made = random_tokens();
    for (const std::string& token : {made.command, made.abort, made.view}) {
      CHECK(token.size() == 64);
      CHECK(token.find_first_not_of("0123456789abcdef") == std::string::npos);
      tokens.insert(token);
    }
  }
  CHECK(tokens.size() == 3000);
}

TEST_CASE("token file: it is found by its port while its writer lives, and gone with it",
          "[high_level][mission]") {
  const Place place;
  const CommandTokens tokens = random_tokens();
  {
    const TokenFile file{kPort, tokens};
    CHECK(file.path().parent_path() == place.path());
    CHECK((mode_of(file.path()) & 0137U) == 0);  // at most rw-r-----
    REQUIRE(find_token_file(kPort) == file.path());
    CHECK(read_token(file.path()) == tokens.command);
    CHECK(read_tokens(file.path()).abort == tokens.abort);
    CHECK(read_tokens(file.path()).view == tokens.view);
    CHECK_FALSE(find_token_file(kPort + 1));
  }
  CHECK_FALSE(find_token_file(kPort));
  CHECK(fs::is_empty(place.path()));
}

TEST_CASE("token file: what a killed writer left is not found, and is gone with the next",
          "[high_level][mission]") {
  const Place place;
  const pid_t child = fork();
  if (child == 0) {
    const TokenFile file{kPort, {std::string(64, 'a'), "", ""}};
    raise(SIGKILL);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
  CHECK(std::distance(fs::directory_iterator{place.path()}, fs::directory_iterator{}) == 1);
  CHECK_FALSE(find_token_file(kPort));
  const TokenFile next{kPort + 1, {std::string(64, 'b'), "", ""}};
  CHECK(std::distance(fs::directory_iterator{place.path()}, fs::directory_iterator{}) == 1);
  CHECK(find_token_file(kPort + 1) == next.path());
}

TEST_CASE("token file: the one that took its name stays", "[high_level][mission]") {
  const Place place;
  auto first = std::make_unique<TokenFile>(kPort, CommandTokens{std::string(64, 'a'), "", ""});
  const TokenFile second{kPort, {std::string(64, 'b'), "", ""}};
  first.reset();
  REQUIRE(find_token_file(kPort) == second.path());
  CHECK(read_token(second.path()) == std::string(64, 'b'));
}

TEST_CASE("token file: a directory that others can write is not used", "[high_level][mission]") {
  const Place place;
  REQUIRE(chmod(place.path().c_str(), 0777) == 0);
  const TokenFile file{kPort, {std::string(64, 'a'), "", ""}};
  CHECK(file.path().parent_path() != place.path());
  const Place linked;
  fs::create_directory_symlink(place.path(), linked.path() / "link");
  REQUIRE(chmod(place.path().c_str(), 0700) == 0);
  setenv("RUNTIME_DIRECTORY", (linked.path() / "link").c_str(), 1);
  const TokenFile other{kPort + 1, {std::string(64, 'a'), "", ""}};
  CHECK(other.path().parent_path() != linked.path() / "link");
}

TEST_CASE("token file: a file that others can read or change, or that holds no token, is refused",
          "[high_level][mission]") {
  const Place place;
  const std::string good(32, 'x');
  CHECK(read_token(place.file("good", good + "\nmore\n", 0600)) == good);
  CHECK(read_token(place.file("group", good, 0640)) == good);
  for (const mode_t mode : {0644U, 0602U, 0660U, 0601U}) {
    CHECK_THROWS_AS(read_token(place.file("open", good, mode)), StartupError);
  }
  CHECK_THROWS_AS(read_token(place.file("short", std::string(31, 'x'), 0600)), StartupError);
  CHECK_THROWS_AS(read_token(place.file("empty", "", 0600)), StartupError);
  CHECK_THROWS_AS(read_token(place.file("long", std::string(2000, 'x'), 0600)), StartupError);
  CHECK_THROWS_AS(read_token(place.path()), StartupError);
  CHECK_THROWS_WITH(
      read_token(place.path() / "none"),
      (place.path() / "none").string() + ":1: token: cannot be read: No such file or directory");
}

TEST_CASE("token file: one that lasts is made once, for its owner and the group",
          "[high_level][mission]") {
  const Place place;
  const fs::path file = place.path() / "boat.token";
  make_token_file(file);
  CHECK((mode_of(file) & 0137U) == 0);  // at most rw-r-----
  const CommandTokens tokens = read_lasting_tokens(file, Reach::kNetwork);
  for (const std::string& token : {tokens.command, tokens.abort, tokens.view}) {
    CHECK(is_random_token(token));
  }
  CHECK(tokens.command != tokens.abort);
  CHECK_THROWS_WITH(make_token_file(file),
                    file.string() + ":1: token: cannot be made: File exists");
  CHECK(read_token(file) == tokens.command);
  CHECK_THROWS_AS(make_token_file(place.path() / "no" / "boat.token"), StartupError);
}

TEST_CASE("token file: beyond loopback a token is 64 hexadecimal digits, each that there is",
          "[high_level][mission]") {
  const Place place;
  const std::string good(64, 'a');
  const std::string phrase = "correct horse battery staple, and more";
  CHECK(read_lasting_tokens(place.file("phrase", phrase, 0600), Reach::kLoopback).command ==
        phrase);
  CHECK_THROWS_WITH(read_lasting_tokens(place.path() / "phrase", Reach::kNetwork),
                    (place.path() / "phrase").string() +
                        ":1: token: must be 64 hexadecimal digits beyond loopback, by chance: "
                        "lodesman token --new FILE makes some");
  CHECK(read_lasting_tokens(place.file("one", good + "\n", 0600), Reach::kNetwork).abort.empty());
  CHECK_THROWS_AS(
      read_lasting_tokens(place.file("two", good + "\n" + phrase + "\n", 0600), Reach::kNetwork),
      StartupError);
  CHECK_THROWS_AS(
      read_lasting_tokens(place.file("upper", std::string(64, 'A'), 0600), Reach::kNetwork),
      StartupError);
}

TEST_CASE("token file: a boat goes by none that belongs to another user", "[high_level][mission]") {
  const Place place;
  const fs::path file = place.file("boat.token", std::string(64, 'a'), 0640);
  CHECK(read_lasting_tokens(file, Reach::kNetwork).command == std::string(64, 'a'));
  if (geteuid() != 0) {
    std::cout << "skipped: no right to give a file away\n";
    return;
  }
  REQUIRE(chown(file.c_str(), 65534, static_cast<gid_t>(-1)) == 0);
  CHECK_THROWS_WITH(read_lasting_tokens(file, Reach::kNetwork),
                    file.string() + ":1: token: belongs to another user; chown root mends that");
  CHECK(read_token(file) == std::string(64, 'a'));  // a client's own affair
}
