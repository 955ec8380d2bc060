// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/console/static_files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "deploy/boat/configuration.h"

namespace lodesman::console {
namespace fs = std::filesystem;
namespace {

// What other packages install: the first place that has it counts.
struct ForeignFile {
  const char* name;
  std::array<const char*, 3> places;
};
constexpr std::array<ForeignFile, 3> kForeign{
    {{"lib/dygraph.min.js",
      {"/usr/share/javascript/dygraphs/dygraph.min.js",
       "/usr/share/nodejs/dygraphs/dist/dygraph.min.js",
       "/usr/share/javascript/dygraphs/dygraph.js"}},
     {"lib/dygraph.css",
      {"/usr/share/javascript/dygraphs/dygraph.css",
       "/usr/share/javascript/dygraphs/dygraph.min.css",
       "/usr/share/nodejs/dygraphs/dist/dygraph.css"}},
     {"lib/chart.min.js",
      {"/usr/share/javascript/chart.js/Chart.min.js", "/usr/share/javascript/chart.js/chart.min.js",
       "/usr/share/nodejs/chart.js/dist/chart.min.js"}}}};

[[nodiscard]] std::optional<std::string> contents(const fs::path& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  struct stat about {};
  std::optional<std::string> text;
  if (descriptor >= 0 && fstat(descriptor, &about) == 0 && S_ISREG(about.st_mode) &&
      about.st_size <= static_cast<off_t>(StaticFiles::kMaxBytes)) {
    text.emplace(static_cast<std::size_t>(about.st_size), '\0');
    std::size_t had = 0;
    for (ssize_t got = 1; got > 0 && had < text->size();) {
      got = read(descriptor, text->data() + had, text->size() - had);
      had += got > 0 ? static_cast<std::size_t>(got) : 0;
    }
    text->resize(had);
  }
  if (descriptor >= 0) {
    close(descriptor);
  }
  return text;
}

}  // namespace

fs::path page_directory() {
  std::error_code error;
  const fs::path installed = share_directory() / "console";
  return fs::is_directory(installed, error)
             ? installed
             : share_directory() / "deploy" / "operator" / "console" / "page";
}

std::optional<HttpReply> StaticFiles::find(const std::string& target) const {
  const std::string name = page_file(target);
  const std::string type = media_type(name);
  if (name.empty() || type.empty()) {
    return std::nullopt;
  }
  std::optional<std::string> text = contents(page_ / name);
  for (const ForeignFile& foreign : kForeign) {
    for (const char* place : foreign.places) {
      if (!text && name == foreign.name) {
        text = contents(place);
      }
    }
  }
  return text ? std::optional{HttpReply{200, type, *std::move(text), {}}} : std::nullopt;
}

}  // namespace lodesman::console
