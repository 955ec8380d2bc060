// SPDX-License-Identifier: Apache-2.0
#include "low_level/sonar/outline.h"

#include <algorithm>
#include <cmath>

#include "low_level/sonar/thin_line.h"

namespace lodesman {
namespace {

// Two thirds of what smoothing spreads an edge by.
constexpr double kBlurBins = (kSmoothBins - 1) / 3.0;
constexpr std::uint32_t kSideVertices = kMaxVertices / 2;
constexpr double kEnclosedFraction = 0.95;  // of a small echo's area that its ellipse holds

// The area's middle; of one that has none, the vertices'.
Vertex middle_of(std::span<const Vertex> corners) noexcept {
  const Vertex& o = corners[0];
  double doubled = 0.0;
  Vertex sum;
  Vertex mean;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vertex& a = corners[i];
    const Vertex& b = corners[(i + 1) % corners.size()];
    const double cross = (a.x_m - o.x_m) * (b.y_m - o.y_m) - (b.x_m - o.x_m) * (a.y_m - o.y_m);
    doubled += cross;
    sum.x_m += cross * (a.x_m + b.x_m - 2.0 * o.x_m);
    sum.y_m += cross * (a.y_m + b.y_m - 2.0 * o.y_m);
    mean.x_m += a.x_m / static_cast<double>(corners.size());
    mean.y_m += a.y_m / static_cast<double>(corners.size());
  }
  if (std::abs(doubled) < 1e-9) {
    return mean;
  }
  return {o.x_m + sum.x_m / (3.0 * doubled), o.y_m + sum.y_m / (3.0 * doubled)};
}

}  // namespace

EchoOutline::EchoOutline(double longest_ellipse_m)
    : longest_ellipse_m_{longest_ellipse_m}, cells_(EchoPlane::kMaxAcross * EchoPlane::kMaxAlong) {}

void EchoOutline::trace(const PolarGrid& grid, std::span<const BrightRun> runs,
                        Obstacle& out) noexcept {
  out = {};
  take_edges(runs);
  bridge_silent_beams();
  double near_bins = edges_[0].near;
  double far_bins = edges_[0].far;
  for (std::uint32_t i = 0; i < beams_; ++i) {
    near_bins = std::min(near_bins, edges_[i].near);
    far_bins = std::max(far_bins, edges_[i].far);
  }
  nearest_m_ = near_bins * grid.bin_depth_m;
  const double deep_m = (far_bins - near_bins) * grid.bin_depth_m;
  const double wide_m = far_bins * grid.bin_depth_m * grid.beam_width_rad * beams_;
  if (std::max(deep_m, wide_m) < longest_ellipse_m_) {
    write_ellipse(grid, runs, out);
  } else {
    write_polygon(grid, out);
  }
}

void EchoOutline::take_edges(std::span<const BrightRun> runs) noexcept {
  first_beam_ = runs.front().beam;
  beams_ = runs.back().beam - first_beam_ + 1;
  std::fill_n(edges_.begin(), beams_, Edges{});
  for (const BrightRun& run : runs) {
    Edges& edges = edges_[run.beam - first_beam_];
    edges.near = edges.any ? edges.near : run.begin;
    edges.far = run.end;  // the last of a beam is its farthest
    edges.any = true;
  }
  for (std::uint32_t i = 0; i < beams_; ++i) {
    Edges& edges = edges_[i];
    const double blur = std::min(kBlurBins, 0.5 * (edges.far - edges.near - 1.0));
    edges.near += edges.any ? blur : 0.0;
    edges.far -= edges.any ? blur : 0.0;
  }
}

// Beams without an echo of their own, between others that have.
void EchoOutline::bridge_silent_beams() noexcept {
  std::uint32_t last = 0;
  for (std::uint32_t i = 1; i < beams_; ++i) {
    if (!edges_[i].any) {
      continue;
    }
    for (std::uint32_t j = last + 1; j < i; ++j) {
      const double share = (j - last) / static_cast<double>(i - last);
      edges_[j].near = std::lerp(edges_[last].near, edges_[i].near, share);
      edges_[j].far = std::lerp(edges_[last].far, edges_[i].far, share);
    }
    last = i;
  }
}

// One side into `line_`, from port to starboard, thinned out.
std::uint32_t EchoOutline::chain(const PolarGrid& grid, bool near_side) noexcept {
  const auto place = [&](std::uint32_t i, double turn_rad) {
    const double range_m = grid.bin_depth_m * (near_side ? edges_[i].near : edges_[i].far);
    const std::uint32_t beam = first_beam_ + i;
    // A fraction of a beam: its sine is as good as itself.
    const double x = grid.sine[beam] + turn_rad * grid.cosine[beam];
    const double y = grid.cosine[beam] - turn_rad * grid.sine[beam];
    return Vertex{range_m * x, range_m * y};
  };
  // What smoothing spreads sideways is taken off again.
  const double reach_rad = (beams_ > 2 ? 0.0 : 0.5) * grid.beam_width_rad;
  std::uint32_t count = 0;
  line_[count++] = place(0, -reach_rad);
  for (std::uint32_t i = 1; i + 1 < beams_; ++i) {
    line_[count++] = place(i, 0.0);
  }
  line_[count++] = place(beams_ - 1, reach_rad);
  return thin_out(std::span{line_}.first(count), grid.bin_depth_m, kSideVertices);
}

void EchoOutline::write_polygon(const PolarGrid& grid, Obstacle& out) noexcept {
  out.shape = ObstacleShape::kPolygon;
  const std::uint32_t near_count = chain(grid, true);
  std::copy_n(line_.begin(), near_count, out.vertices.begin());
  const std::uint32_t far_count = chain(grid, false);
  std::reverse_copy(line_.begin(), line_.begin() + far_count, out.vertices.begin() + near_count);
  out.vertex_count = near_count + far_count;
  const Vertex middle = middle_of(std::span{out.vertices}.first(out.vertex_count));
  out.centre_x_m = middle.x_m;
  out.centre_y_m = middle.y_m;
}

void EchoOutline::write_ellipse(const PolarGrid& grid, std::span<const BrightRun> runs,
                                Obstacle& out) noexcept {
  std::size_t count = 0;
  for (const BrightRun& run : runs) {
    const auto blur =
        static_cast<std::uint32_t>(std::min(kBlurBins, 0.5 * (run.end - run.begin - 1.0)));
    for (std::uint32_t bin = run.begin + blur; bin + blur < run.end; ++bin) {
      cells_[count++] = run.beam * grid.bins + bin;
    }
  }
  const std::span<std::uint32_t> cells = std::span{cells_}.first(count);
  put_ellipse(enclose(grid, cells, moment_ellipse(grid, cells), kEnclosedFraction), out);
}

}  // namespace lodesman
