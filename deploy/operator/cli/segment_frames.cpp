// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/cli/segment_frames.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>
#include <system_error>

#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

namespace fs = std::filesystem;

[[nodiscard]] bool is_frame(const fs::directory_entry& entry) {
  constexpr std::array<std::string_view, 4> kEndings{".pgm", ".png", ".jpg", ".jpeg"};
  std::string ending = entry.path().extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::error_code error;
  return entry.is_regular_file(error) &&
         std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

[[nodiscard]] bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The digits from there on, without leading noughts.
[[nodiscard]] std::string_view number_at(std::string_view name, std::size_t at) {
  std::size_t end = at;
  while (end < name.size() && is_digit(name[end])) {
    ++end;
  }
  while (at + 1 < end && name[at] == '0') {
    ++at;
  }
  return name.substr(at, end - at);
}

// A name's next number, or its next letter.
[[nodiscard]] std::string_view word_at(std::string_view name, std::size_t at) {
  return is_digit(name[at]) ? number_at(name, at) : name.substr(at, 1);
}

[[nodiscard]] bool comes_before(const std::string& a, const std::string& b) {
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < a.size() && j < b.size()) {
    const std::string_view in_a = word_at(a, i);
    const std::string_view in_b = word_at(b, j);
    if (in_a != in_b) {
      const bool numbers = is_digit(a[i]) && is_digit(b[j]);
      return numbers && in_a.size() != in_b.size() ? in_a.size() < in_b.size() : in_a < in_b;
    }
    i = static_cast<std::size_t>(in_a.end() - std::string_view{a}.begin());
    j = static_cast<std::size_t>(in_b.end() - std::string_view{b}.begin());
  }
  const bool a_ends = i == a.size();
  return a_ends && j == b.size() ? a < b : a_ends;
}

[[nodiscard]] std::vector<std::string> frames_in(const std::string& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator it{directory, error}; !error && it != fs::directory_iterator{};
       it.increment(error)) {
    if (is_frame(*it)) {
      names.push_back(it->path().filename().string());
    }
  }
  if (error) {
    throw StartupError{directory, 1, "image", error.message()};
  }
  if (names.empty()) {
    throw StartupError{directory, 1, "image", "the directory has no PGM, PNG or JPEG file"};
  }
  std::sort(names.begin(), names.end(), comes_before);
  for (std::string& name : names) {
    name = (fs::path{directory} / name).string();
  }
  return names;
}

}  // namespace

std::vector<std::string> frame_files(const std::vector<std::string>& named) {
  std::vector<std::string> files;
  for (const std::string& one : named) {
    std::error_code error;
    if (fs::is_directory(one, error)) {
      const std::vector<std::string> frames = frames_in(one);
      files.insert(files.end(), frames.begin(), frames.end());
    } else {
      files.push_back(one);
    }
  }
  return files;
}

}  // namespace lodesman::cli
