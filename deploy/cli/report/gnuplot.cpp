// SPDX-License-Identifier: Apache-2.0
#include "deploy/cli/report/gnuplot.h"

#include <gnuplot-iostream.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>

#include "deploy/cli/report/plot_script.h"
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

// The reason why a file cannot be written is the system's to say: gnuplot would only say that.
void require_writable(const std::filesystem::path& png) {
  errno = 0;
  std::ofstream file{png, std::ios::binary | std::ios::trunc};
  if (!file) {
    throw StartupError(png.string() + ": cannot be written: " +
                       std::generic_category().message(errno != 0 ? errno : EIO));
  }
}

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
  require_writable(png);
  {
    // The shell reads what a failed gnuplot leaves unread: this process would die of SIGPIPE.
    // Outside a UTF-8 locale, as on a bare system, gnuplot 6 warns of a degree sign of its own.
    Gnuplot gnuplot{"LC_ALL=C.UTF-8 gnuplot -d; cat >/dev/null"};
    gnuplot << "set encoding utf8\nset terminal pngcairo noenhanced font 'Sans,13' size "
            << size.width_px << ',' << size.height_px << "\nset output "
            << plot_text(std::filesystem::absolute(png).string()) << '\n'
            << script << "\nunset output\n";
  }
  if (!is_whole_png(png)) {
    std::error_code ignored;
    std::filesystem::remove(png, ignored);
    throw StartupError(png.string() + ": gnuplot could not draw it");
  }
}

}  // namespace lodesman::cli
