// SPDX-License-Identifier: Apache-2.0
#include "high_level/mission/token_file.h"

#include <fcntl.h>
#include <grp.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <system_error>
#include <vector>

#include "high_level/mission/message_code.h"
#include "mid_level/base/startup_error.h"

namespace lodesman {
namespace fs = std::filesystem;
namespace {

constexpr const char* kGroup = "lodesman";
constexpr std::size_t kTokenBytes = 32;
constexpr std::size_t kMinLength = 32;  // [characters] of a token from a file
constexpr std::size_t kMaxLength = 1024;

class Descriptor {
 public:
  explicit Descriptor(int descriptor) noexcept : descriptor_{descriptor} {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (descriptor_ >= 0) {
      close(descriptor_);
    }
  }
  [[nodiscard]] int get() const noexcept { return descriptor_; }
  [[nodiscard]] bool ok() const noexcept { return descriptor_ >= 0; }
  [[nodiscard]] int release() noexcept { return std::exchange(descriptor_, -1); }

 private:
  int descriptor_;
};

[[nodiscard]] std::string reason_of(int error) { return std::generic_category().message(error); }

[[nodiscard]] fs::path from_environment(const char* name) {
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody writes it
  const char* value = std::getenv(name);
  return value != nullptr && *value == '/' ? fs::path{value} : fs::path{};
}

// The best one first. A service manager names the service's own; the system's is root's; the last
// is there where nothing else is.
[[nodiscard]] std::vector<fs::path> token_directories() {
  std::vector<fs::path> places{from_environment("RUNTIME_DIRECTORY")};
  const fs::path system = fs::path{"/run"} / kGroup;
  if (geteuid() == 0) {
    places.push_back(system);
  }
  if (const fs::path session = from_environment("XDG_RUNTIME_DIR"); !session.empty()) {
    places.push_back(session / kGroup);
  }
  places.push_back(fs::path{P_tmpdir} / (std::string{kGroup} + "-" + std::to_string(geteuid())));
  if (geteuid() != 0) {
    places.push_back(system);
  }
  if (places.front().empty()) {
    places.erase(places.begin());
  }
  return places;
}

[[nodiscard]] std::string file_name(std::uint16_t port) {
  return "command-" + std::to_string(port) + ".token";
}

[[nodiscard]] struct flock whole_file(short type) noexcept {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

[[nodiscard]] bool is_locked(int file) noexcept {
  struct flock lock = whole_file(F_WRLCK);
  return fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
}

[[nodiscard]] bool lock(int file) noexcept {
  const struct flock lock = whole_file(F_WRLCK);
  return fcntl(file, F_OFD_SETLK, &lock) == 0;
}

// For the owner alone, or for the group too where there is one and the owner may give it away.
void set_mode(int file, mode_t owner, mode_t group) noexcept {
  std::array<char, 4096> text{};
  struct group entry {};
  struct group* found = nullptr;
  const bool shared = getgrnam_r(kGroup, &entry, text.data(), text.size(), &found) == 0 &&
                      found != nullptr && fchown(file, static_cast<uid_t>(-1), found->gr_gid) == 0;
  static_cast<void>(fchmod(file, shared ? owner | group : owner));
}

// Makes it, or takes one that nobody else can write.
[[nodiscard]] int open_own_directory(const fs::path& directory) {
  const bool made = mkdir(directory.c_str(), S_IRWXU) == 0;
  Descriptor opened{open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)};
  struct stat status {};
  if (!opened.ok() || fstat(opened.get(), &status) != 0) {
    return -1;
  }
  if (status.st_uid != geteuid() || (status.st_mode & (S_IWGRP | S_IWOTH)) != 0) {
    errno = EPERM;
    return -1;
  }
  if (made) {
    set_mode(opened.get(), S_IRWXU, S_IRGRP | S_IXGRP);
  }
  return opened.release();
}

[[nodiscard]] bool same_file(int directory, const std::string& name, int file) noexcept {
  struct stat by_name {};
  struct stat opened {};
  return fstatat(directory, name.c_str(), &by_name, AT_SYMLINK_NOFOLLOW) == 0 &&
         fstat(file, &opened) == 0 && by_name.st_ino == opened.st_ino &&
         by_name.st_dev == opened.st_dev;
}

// What programs that were killed have left.
void remove_the_dead(int directory, const fs::path& path) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator{path, error}) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("command-") || !name.ends_with(".token")) {
      continue;
    }
    const Descriptor file{openat(directory, name.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC)};
    if (file.ok() && lock(file.get()) && same_file(directory, name, file.get())) {
      unlinkat(directory, name.c_str(), 0);
    }
  }
}

// Whole or not at all: written under another name first. -1 and errno where it cannot be.
[[nodiscard]] int write_token(int directory, const std::string& name, const std::string& token) {
  const std::string draft = "." + name + "." + std::to_string(getpid());
  unlinkat(directory, draft.c_str(), 0);  // of an earlier program with this number
  Descriptor file{openat(directory, draft.c_str(),
                         O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR)};
  if (!file.ok()) {
    return -1;
  }
  const std::string line = token + "\n";
  const bool written = lock(file.get()) && write(file.get(), line.data(), line.size()) ==
                                               static_cast<ssize_t>(line.size());
  set_mode(file.get(), S_IRUSR | S_IWUSR, S_IRGRP);
  if (!written || renameat(directory, draft.c_str(), directory, name.c_str()) != 0) {
    unlinkat(directory, draft.c_str(), 0);
    return -1;
  }
  return file.release();
}

[[nodiscard]] std::string random_token() {
  std::array<unsigned char, kTokenBytes> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw StartupError("command_socket: no random numbers for a token: " + reason_of(errno));
  }
  std::string token;
  for (const unsigned char byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

enum class IsOwner : std::uint8_t { kAnybody, kUserOrRoot };

[[nodiscard]] CommandTokens tokens_in(const fs::path& path, IsOwner owner) {
  const auto refuse = [&](const std::string& reason) {
    return StartupError(path.string(), 1, "token", reason);
  };
  const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)};
  struct stat status {};
  if (!file.ok() || fstat(file.get(), &status) != 0) {
    throw refuse("cannot be read: " + reason_of(errno));
  }
  if (!S_ISREG(status.st_mode)) {
    throw refuse("is no file");
  }
  if ((status.st_mode & (S_IRWXO | S_IWGRP)) != 0) {
    throw refuse("others may read or change it; chmod 600 mends that");
  }
  if (owner == IsOwner::kUserOrRoot && status.st_uid != geteuid() && status.st_uid != 0) {
    throw refuse("belongs to another user; chown root mends that");
  }
  std::array<char, 3 * (kMaxLength + 1) + 1> text{};
  const ssize_t length = read(file.get(), text.data(), text.size());
  std::istringstream lines{{text.data(), length > 0 ? static_cast<std::size_t>(length) : 0U}};
  CommandTokens tokens;
  for (std::string* token : {&tokens.command, &tokens.abort, &tokens.view}) {
    std::getline(lines, *token);
    const bool no_token = token->size() < kMinLength || token->size() > kMaxLength;
    if (no_token && token != &tokens.command) {
      token->clear();  // nobody's
    } else if (no_token) {
      throw refuse("must be a line of " + std::to_string(kMinLength) + " to " +
                   std::to_string(kMaxLength) + " characters");
    }
  }
  return tokens;
}

[[nodiscard]] std::string text_of(const CommandTokens& tokens) {
  return tokens.command + "\n" + tokens.abort + "\n" + tokens.view;
}

}  // namespace

CommandTokens random_tokens() { return {random_token(), random_token(), random_token()}; }

CommandTokens read_tokens(const fs::path& path) { return tokens_in(path, IsOwner::kAnybody); }

std::string read_token(const fs::path& path) { return read_tokens(path).command; }

bool is_random_token(const std::string& token) noexcept { return digest_of(token).has_value(); }

CommandTokens read_lasting_tokens(const fs::path& path, Reach reach) {
  CommandTokens tokens = tokens_in(path, IsOwner::kUserOrRoot);
  std::size_t line = 0;
  for (const std::string& token : {tokens.command, tokens.abort, tokens.view}) {
    ++line;
    if (reach == Reach::kNetwork && !token.empty() && !is_random_token(token)) {
      throw StartupError(path.string(), line, "token",
                         "must be 64 hexadecimal digits beyond loopback, by chance: "
                         "lodesman token --new FILE makes some");
    }
  }
  return tokens;
}

void make_token_file(const fs::path& path) {
  const auto refuse = [&] {
    return StartupError(path.string(), 1, "token", "cannot be made: " + reason_of(errno));
  };
  const CommandTokens tokens = random_tokens();
  const Descriptor file{
      open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, S_IRUSR | S_IWUSR)};
  if (!file.ok()) {
    throw refuse();
  }
  const std::string text = text_of(tokens) + "\n";
  const bool written =
      write(file.get(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      fsync(file.get()) == 0;
  set_mode(file.get(), S_IRUSR | S_IWUSR, S_IRGRP);
  if (!written) {
    const StartupError why = refuse();
    unlink(path.c_str());
    throw why;
  }
}

std::optional<fs::path> find_token_file(std::uint16_t port) {
  for (const fs::path& directory : token_directories()) {
    const fs::path path = directory / file_name(port);
    const Descriptor file{open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK)};
    const bool forbidden = !file.ok() && errno == EACCES;
    if (forbidden || (file.ok() && is_locked(file.get()))) {
      return path;
    }
  }
  return std::nullopt;
}

TokenFile::TokenFile(std::uint16_t port, const CommandTokens& tokens) {
  const std::string text = text_of(tokens);
  std::string tried;
  const std::string name = file_name(port);
  for (const fs::path& place : token_directories()) {
    const Descriptor directory{open_own_directory(place)};
    if (directory.ok()) {
      remove_the_dead(directory.get(), place);
      descriptor_ = write_token(directory.get(), name, text);
    }
    if (descriptor_ >= 0) {
      path_ = place / name;
      return;
    }
    tried += (tried.empty() ? "" : "; ") + place.string() + ": " + reason_of(errno);
  }
  throw StartupError("command_socket.token_file: cannot be written by itself (" + tried + ")");
}

TokenFile::~TokenFile() {
  const Descriptor file{descriptor_};
  const Descriptor directory{open(path_.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (directory.ok() && same_file(directory.get(), path_.filename().string(), file.get())) {
    unlinkat(directory.get(), path_.filename().c_str(), 0);
  }
}

}  // namespace lodesman
