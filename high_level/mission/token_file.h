// SPDX-License-Identifier: Apache-2.0
// The credential of the command socket: tokens in a file that only its owner, and the group
// `lodesman` where there is one, can read. Whoever can read it commands the boat. One is written
// for each run and found by the port; another, made once, lasts and may be carried ashore. Any
// thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "high_level/mission/command_line.h"
#include "high_level/mission/network.h"

namespace lodesman {

// Each 256 bits from the kernel, in hexadecimal. Throws StartupError.
[[nodiscard]] CommandTokens random_tokens();

// The first lines of a file that nobody else can read or change: the token to command, that to
// abort and that to view. A second or third line that is too short for a token is none. Throws
// StartupError.
[[nodiscard]] CommandTokens read_tokens(const std::filesystem::path& file);
// The first line alone: what a client shows or proves.
[[nodiscard]] std::string read_token(const std::filesystem::path& file);

// The tokens that a boat goes by for as long as the file is there. Refused too where it belongs to
// neither this user nor root; and, for a boat that is reached over a network, where a token is not
// as random_tokens() makes it, since a listener may try guesses at leisure on what it has heard.
[[nodiscard]] CommandTokens read_lasting_tokens(const std::filesystem::path& file, Reach reach);
// Whether it has the form of those of random_tokens(): 64 hexadecimal digits.
[[nodiscard]] bool is_random_token(const std::string& token) noexcept;
// Makes such a file with new tokens: 0600, or 0640 for the group. Throws StartupError where it
// cannot, or where there is a file already.
void make_token_file(const std::filesystem::path& file);

// The file that a running boat wrote for its command socket on this port, in a directory of this
// user or of the system. Nothing where no program that lives has written one.
[[nodiscard]] std::optional<std::filesystem::path> find_token_file(std::uint16_t port);

// Tokens written where find_token_file() looks for them, as long as this lives.
class TokenFile {
 public:
  // Throws StartupError when no directory will do.
  TokenFile(std::uint16_t port, const CommandTokens& tokens);
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;
  ~TokenFile();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;  // locked: that says that the writer lives
};

}  // namespace lodesman
