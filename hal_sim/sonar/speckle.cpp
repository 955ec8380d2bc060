// SPDX-License-Identifier: Apache-2.0
#include "hal_sim/sonar/speckle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lodesman {
namespace {

// Measured: the shape of its distribution, which has a coefficient of variation of 0.31.
constexpr double kWeibullShape = 3.6;
// The correlation of neighbours is that of a fine grain, what a cell shares with the next one each
// way, and of a coarse one, the means over so many cells. Together, once rounded to whole levels,
// they have the measured 0.68, 0.31 and 0.11 at 1, 2 and 4 bins and 0.31 and 0.15 at 1 and 2 beams.
constexpr float kSharedAlong = 0.55F;
constexpr float kSharedAcross = 0.10F;
constexpr float kCoarseVariance = 0.07F;
constexpr std::uint32_t kCoarseBins = 25;
constexpr std::uint32_t kCoarseBeams = 9;
// How much larger than a ping the field is: so many times so many different pings, and as many
// mirrored. Both odd, so that they are no multiples of each other.
constexpr std::uint32_t kSpareBeams = 63;
constexpr std::uint32_t kSpareBins = 255;

// Normal, mean 0, variance 1, row by row; each operation works in place.
class Grain {
 public:
  Grain(std::uint32_t rows, std::uint32_t width, RandomStream& chance)
      : rows_{rows},
        width_{width},
        cells_(std::size_t{rows} * width),
        line_(std::max(rows, width)) {
    std::generate(cells_.begin(), cells_.end(),
                  [&] { return static_cast<float>(chance.gaussian()); });
  }
  // Each with a share of its neighbours; the ends meet.
  void share(float along, float across) {
    for_each_line([&](std::size_t count, auto at) {
      const float share = at.along ? along : across;
      const float norm = 1.0F / std::sqrt(1.0F + 2.0F * share * share);
      for (std::size_t i = 0; i < count; ++i) {
        line_[i] = norm * (at(i) + share * (at((i + count - 1) % count) + at((i + 1) % count)));
      }
    });
  }
  // Each the mean of so many, scaled to variance 1; the ends meet.
  void blur(std::uint32_t along, std::uint32_t across) {
    for_each_line([&](std::size_t count, auto at) {
      const std::size_t taken = std::min<std::size_t>(at.along ? along : across, count);
      const float norm = 1.0F / std::sqrt(static_cast<float>(taken));
      double sum = 0.0;
      for (std::size_t i = 0; i < taken; ++i) {
        sum += static_cast<double>(at(i));
      }
      for (std::size_t i = 0; i < count; ++i) {
        line_[i] = norm * static_cast<float>(sum);
        sum += static_cast<double>(at((i + taken) % count)) - static_cast<double>(at(i));
      }
    });
  }
  [[nodiscard]] const std::vector<float>& cells() const { return cells_; }

 private:
  struct Line {
    float* first;
    std::size_t step;
    bool along;
    [[nodiscard]] float& operator()(std::size_t i) const { return first[i * step]; }
  };
  // `fill` fills line_ of a line of the field; then it takes the line's place.
  template <class Fill>
  void for_each_line(Fill fill) {
    for (std::size_t row = 0; row < rows_; ++row) {
      fill(width_, Line{cells_.data() + row * width_, 1, true});
      std::copy_n(line_.begin(), width_,
                  cells_.begin() + static_cast<std::ptrdiff_t>(row * width_));
    }
    for (std::size_t column = 0; column < width_; ++column) {
      const Line line{cells_.data() + column, width_, false};
      fill(rows_, line);
      for (std::size_t i = 0; i < rows_; ++i) {
        line(i) = line_[i];
      }
    }
  }

  std::size_t rows_;
  std::size_t width_;
  std::vector<float> cells_;
  std::vector<float> line_;
};

// Of mean 1, the Weibull value that as many are below as are below this normal one.
[[nodiscard]] double weibull_of(double normal) noexcept {
  const double above = 0.5 * std::erfc(normal / std::numbers::sqrt2);
  const double scale = 1.0 / std::tgamma(1.0 + 1.0 / kWeibullShape);
  return scale * std::pow(-std::log(std::max(above, 1e-12)), 1.0 / kWeibullShape);
}

}  // namespace

SpeckleField::SpeckleField(std::uint32_t beams, std::uint32_t bins, RandomStream& chance)
    : beams_{beams}, bins_{bins}, width_{bins + kSpareBins} {
  const std::uint32_t rows = beams + kSpareBeams;
  Grain fine{rows, width_, chance};
  fine.share(kSharedAlong, kSharedAcross);
  Grain coarse{rows, width_, chance};
  coarse.blur(kCoarseBins, kCoarseBeams);
  const float of_fine = std::sqrt(1.0F - kCoarseVariance);
  const float of_coarse = std::sqrt(kCoarseVariance);
  field_.reserve(fine.cells().size());
  std::transform(
      fine.cells().begin(), fine.cells().end(), coarse.cells().begin(), std::back_inserter(field_),
      [&](float f, float c) {
        return static_cast<float>(weibull_of(static_cast<double>(of_fine * f + of_coarse * c)));
      });
}

void SpeckleField::choose_part(RandomStream& chance) noexcept {
  const auto one_of = [&](std::uint32_t count) noexcept {
    return static_cast<std::uint32_t>(chance.uniform() * static_cast<double>(count));
  };
  first_beam_ = one_of(kSpareBeams + 1);
  first_bin_ = one_of(kSpareBins + 1);
  mirrored_ = one_of(2) == 1;
}

std::span<const float> SpeckleField::beam(std::uint32_t beam) const noexcept {
  const std::size_t row = first_beam_ + (mirrored_ ? beams_ - 1 - beam : beam);
  return {field_.data() + row * width_ + first_bin_, bins_};
}

}  // namespace lodesman
