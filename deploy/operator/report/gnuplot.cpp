// SPDX-License-Identifier: Apache-2.0
#include "deploy/operator/report/gnuplot.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <string_view>
#include <system_error>
#include <vector>

#include "deploy/operator/report/output_file.h"
#include "deploy/operator/report/program_call.h"
#include "mid_level/base/startup_error.h"

namespace lodesman::cli {
namespace {

// The file that gnuplot draws into, as its standard output: a path may hold what would end a line
// of its script, and why a file cannot be written is the system's to say.
class Canvas {
 public:
  explicit Canvas(const std::filesystem::path& png)
      : file_{unfinished(png)},
        descriptor_{::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)} {
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
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  std::filesystem::path file_;
  int descriptor_;
};

// gnuplot does not notice a full disk: the picture itself must be whole, from its signature to its
// last chunk.
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

// The picture's directory is gnuplot's own meanwhile: to gnuplot some first letters of a file's
// name are commands.
void run_gnuplot(const std::filesystem::path& png, std::vector<std::string> words,
                 std::string_view input) {
  const Canvas canvas{png};
  words.insert(words.begin(), {"gnuplot", "-d"});
  const auto directory = png.has_parent_path() ? png.parent_path() : std::filesystem::path{"."};
  const ProgramResult result = run_program({words, directory, input, canvas.descriptor()});
  if (result.end == ProgramEnd::kMissing) {
    throw StartupError(png.string() + ": gnuplot is missing: apt-get install gnuplot-nox");
  }
  std::error_code failed;
  if (result.end == ProgramEnd::kSuccess && is_whole_png(canvas.file())) {
    std::filesystem::rename(canvas.file(), png, failed);
    if (!failed) {
      return;
    }
  }
  throw StartupError(png.string() + ": gnuplot could not draw it" +
                     (result.reason.empty() ? "" : ": " + result.reason));
}

}  // namespace

void draw_picture(const std::filesystem::path& png, PictureSize size, const std::string& script) {
  run_gnuplot(png, {},
              "set encoding utf8\nset terminal pngcairo noenhanced font 'Sans,13' size " +
                  std::to_string(size.width_px) + ',' + std::to_string(size.height_px) +
                  "\nset output\n" + script + "\nunset output\n");
}

void draw_by_file(const std::filesystem::path& png, const std::filesystem::path& script,
                  const std::string& variables) {
  run_gnuplot(png,
              {"-e", variables + "output = '/dev/stdout'", "-c",
               std::filesystem::absolute(script).string()},
              {});
}

}  // namespace lodesman::cli
