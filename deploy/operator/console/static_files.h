// SPDX-License-Identifier: Apache-2.0
// The page's files, and the few of other packages that it uses, read anew each time they are asked
// for. One thread; it waits for the disk.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "deploy/operator/console/http_rules.h"

namespace lodesman::console {

// Where the page lies: installed, or in the source tree.
[[nodiscard]] std::filesystem::path page_directory();

class StaticFiles {
 public:
  static constexpr std::size_t kMaxBytes = std::size_t{4} << 20;

  explicit StaticFiles(std::filesystem::path page) : page_{std::move(page)} {}

  // For a target that means one; nothing where there is none, or it is none of the page's kinds.
  [[nodiscard]] std::optional<HttpReply> find(const std::string& target) const;

 private:
  std::filesystem::path page_;
};

}  // namespace lodesman::console
