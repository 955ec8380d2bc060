// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/gnuplot.h"

#include <fcntl.h>
#include <gnuplot-iostream.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "deploy/operator/report/output_file.h"
#include "deploy/operator/report/plot_script.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

bool gnuplot_is_installed() {
  const char* path = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody writes it
  std::istringstream folders{path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin"};
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (::access((std::filesystem::path{folder} / "gnuplot").c_str(), X_OK) == 0) {
      return true;
    }
  }
  return false;
}

// The file that gnuplot draws into, which it knows by its number: a path may hold what would end a
// line of its script, and why a file cannot be written is the system's to say.
class Canvas {
 public:
  explicit Canvas(const std::filesystem::path& png)
      : file_{unfinished(png)},
        // Not closed at exec: gnuplot is to find it.
        descriptor_{::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666)} {
    if (descriptor_ < 0) {
      throw StartupError(png.string() +
                         ": cannot be written: " + std::generic_category().message(errno));
    }
  }
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;
  ~Canvas() {
    ::close(descriptor_);
    std::error_code ignored;
    std::filesystem::remove(file_, ignored);  // where it has not become the picture
  }

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  [[nodiscard]] std::string name() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  std::filesystem::path file_;
  int descriptor_;
};

// gnuplot-iostream keeps gnuplot's exit status to itself, and a full disk would not show in it:
// the picture itself must be whole, from its signature to its last chunk.
bool is_whole_png(const std::filesystem::path& png) {
  constexpr std::string_view kSignature{"\x89PNG\r\n\x1a\n"};
  constexpr std::string_view kEndChunk{"IEND\xae\x42\x60\x82"};
  std::ifstream file{png, std::ios::binary};
  std::array<char, 8> first{};
  std::array<char, 8> last{};
  file.read(first.data(), first.size());
  file.seekg(-8, std::ios::end);
  file.read(last.data(), last.size());
  return file && std::string_view{first.data(), first.size()} == kSignature &&
         std::string_view{last.data(), last.size()} == kEndChunk;
}

}  // namespace

void draw_picture(const std::filesystem::path& png, PictureSize size, const std::string& script) {
  if (!gnuplot_is_installed()) {
    throw StartupError(png.string() + ": gnuplot is missing: apt-get install gnuplot-nox");
  }
  const Canvas canvas{png};
  {
    // The shell reads what a failed gnuplot leaves unread. Outside a UTF-8 locale, as on a bare
    // system, gnuplot 6 warns of a degree sign of its own.
    Gnuplot gnuplot{"LC_ALL=C.UTF-8 gnuplot -d; cat >/dev/null"};
    gnuplot << "set encoding utf8\nset terminal pngcairo noenhanced font 'Sans,13' size "
            << size.width_px << ',' << size.height_px << "\nset output " << plot_text(canvas.name())
            << '\n'
            << script << "\nunset output\n";
  }
  std::error_code failed;
  if (is_whole_png(canvas.file())) {
    std::filesystem::rename(canvas.file(), png, failed);
    if (!failed) {
      return;
    }
  }
  throw StartupError(png.string() + ": gnuplot could not draw it");
}

}  // namespace lodesman::cli
