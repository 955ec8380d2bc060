// SPDX-License-Identifier: Apache-2.0
// The credential of the command socket: a token in a file that only its owner, and the group
// `lodesman` where there is one, can read. Whoever can read it commands the boat. Any thread.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

namespace lodesman {

// 256 bits from the kernel, in hexadecimal. Throws StartupError.
[[nodiscard]] std::string random_token();

// The first line of a file that nobody else can read or change. Throws StartupError.
[[nodiscard]] std::string read_token(const std::filesystem::path& file);

// The file that a running boat wrote for its command socket on this port, in a directory of this
// user or of the system. Nothing where no program that lives has written one.
[[nodiscard]] std::optional<std::filesystem::path> find_token_file(std::uint16_t port);

// A token written where find_token_file() looks for it, as long as this lives.
class TokenFile {
 public:
  // Throws StartupError when no directory will do.
  TokenFile(std::uint16_t port, const std::string& token);
  TokenFile(const TokenFile&) = delete;
  TokenFile& operator=(const TokenFile&) = delete;
  ~TokenFile();

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;  // locked: that says that the writer lives
};

}  // namespace lodesman
