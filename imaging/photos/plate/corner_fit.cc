#include "imaging/photos/plate/corner_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/normal.h"

namespace talus::imaging {
namespace {

constexpr int kSlopeAtSide = 0;  // b
constexpr int kShelfSquared = 1;
constexpr int kAngle = 2;
constexpr int kSide = 3;  // where it is, x [px]
constexpr int kBlur = 4;
constexpr int kDark = 5;
constexpr int kLight = 6;
constexpr int kBend = 7;  // c
constexpr int kNumParameters = 8;
using Parameters = std::array<double, kNumParameters>;

constexpr double kLevelNoise = 0.02;    // usual, of a pixel [-]
constexpr double kBlurNoise = 0.02;     // relative, of the blur that the sides have [-]
constexpr double kLeastSquared = 1e-4;  // of the shelf [px²]: a derivative divides by its root

// C of one pixel, and its derivatives.
struct Cover {
  double share = 0;
  Parameters by{};
};

class BlurredCorner {
 public:
  BlurredCorner(const Parameters& p, double farthest)
      : farthest_(farthest),
        at_side_(p[kSlopeAtSide]),
        shelf_(std::sqrt(p[kShelfSquared])),
        slope_(std::tan(p[kAngle])),
        side_(p[kSide]),
        blur_(p[kBlur]),
        bend_(p[kBend]) {}

  double Height(double x) const {
    const double run = std::max(x, shelf_);
    return at_side_ + run * slope_ + bend_ * Sag(run);
  }

  Cover At(const SeenPixel& pixel) const {
    constexpr double kSpread = 3.5;  // of the blur
    const double in = pixel.in - side_;
    const double first = std::max(0.0, in - kSpread * blur_);
    const double last = std::max(first, in + kSpread * blur_);
    const double foot = std::clamp(shelf_, first, last);
    Cover cover;
    Integrate(first, foot, {.in = in, .up = pixel.up}, cover);
    Integrate(foot, last, {.in = in, .up = pixel.up}, cover);
    return cover;
  }

 private:
  double Sag(double run) const { return run * (run - farthest_) / 2; }

  // By the midpoint rule over x′, on either side of the slope's foot.
  void Integrate(double from, double to, const SeenPixel& pixel, Cover& cover) const {
    constexpr double kStep = 0.45;  // of the blur
    const int num_steps = static_cast<int>(std::ceil((to - from) / (kStep * blur_)));
    const double step = (to - from) / num_steps;
    const double slope_at_foot = slope_ + bend_ * (shelf_ - farthest_ / 2);
    for (int i = 0; i < num_steps; ++i) {
      const double x = from + (i + 0.5) * step;
      const double run = std::max(x, shelf_);
      const double across = (pixel.in - x) / blur_;
      const double below = (Height(x) - pixel.up) / blur_;
      const double weight = base::NormalDensity(across) * step / blur_;
      const double dark = weight * base::NormalProbability(below);
      const double by_height = weight * base::NormalDensity(below) / blur_;
      cover.share += dark;
      cover.by[kSlopeAtSide] += by_height;
      if (x < shelf_) cover.by[kShelfSquared] += by_height * slope_at_foot / (2 * shelf_);
      cover.by[kBend] += by_height * Sag(run);
      cover.by[kAngle] += by_height * run * (1 + slope_ * slope_);
      cover.by[kSide] += dark * across / blur_;
      cover.by[kBlur] += dark * (across * across - 1) / blur_ - by_height * below;
    }
  }

  double farthest_;
  double at_side_;
  double shelf_;
  double slope_;
  double side_;
  double blur_;
  double bend_;
};

// One residual a pixel, and two that hold blur and bend near what is known of them.
class LikeCorner : public ceres::CostFunction {
 public:
  LikeCorner(const std::vector<SeenPixel>& pixels, const CornerGuess& guess)
      : pixels_(pixels), guess_(guess) {
    set_num_residuals(static_cast<int>(pixels.size()) + 2);
    mutable_parameter_block_sizes()->push_back(kNumParameters);
  }

  bool Evaluate(const double* const* blocks, double* residuals, double** jacobians) const override {
    Parameters p;
    std::copy_n(blocks[0], p.size(), p.begin());
    const BlurredCorner corner(p, guess_.farthest);
    const double contrast = p[kLight] - p[kDark];
    double* row = jacobians != nullptr ? jacobians[0] : nullptr;
    for (const SeenPixel& pixel : pixels_) {
      const Cover cover = corner.At(pixel);
      *residuals++ = p[kLight] - contrast * cover.share - pixel.level;
      if (row == nullptr) continue;
      std::ranges::transform(cover.by, row, [&](double by) { return -contrast * by; });
      row[kDark] = cover.share;
      row[kLight] = 1 - cover.share;
      row += kNumParameters;
    }
    const double blur_weight = kLevelNoise / (kBlurNoise * guess_.blur);
    *residuals++ = blur_weight * (p[kBlur] - guess_.blur);
    const double bend_weight = kLevelNoise / guess_.bend;
    *residuals = bend_weight * p[kBend];
    if (row == nullptr) return true;
    std::fill_n(row, 2 * kNumParameters, 0.0);
    row[kBlur] = blur_weight;
    row[kNumParameters + kBend] = bend_weight;
    return true;
  }

 private:
  const std::vector<SeenPixel>& pixels_;
  const CornerGuess& guess_;
};

struct Fitted {
  Parameters at{};
  double squares = 0;  // sum of the squared residuals
};

class CornerFit {
 public:
  CornerFit(const std::vector<SeenPixel>& pixels, const CornerGuess& guess)
      : pixels_(pixels), guess_(guess) {}

  Fitted WithShelf() const {
    return Solve({guess_.slope_at_side, std::max(1.0, guess_.shelf * guess_.shelf),
                  std::atan(std::max(0.02, guess_.slope)), 0, guess_.blur, guess_.dark, 1, 0},
                 true);
  }
  Fitted AtRim(Parameters start) const {
    start[kSlopeAtSide] = (Top(start) + start[kSlopeAtSide]) / 2;
    start[kShelfSquared] = kLeastSquared;
    return Solve(start, false);
  }
  double Top(const Parameters& p) const { return BlurredCorner(p, guess_.farthest).Height(0); }

  // Whether the pixels on the edge are off by more than those beside it: noise is in both.
  bool IsPoor(const Parameters& p) const {
    constexpr double kSharp = 0.6;  // a lesser blur is more a pixel's square than Gaussian [px]
    const double misfit = 0.03 * std::max(1.0, kSharp / p[kBlur]);  // of the contrast
    constexpr double kFlat = 0.02;                                  // C is so near to 0 or 1
    const BlurredCorner corner(p, guess_.farthest);
    double edge = 0, num_edge = 1, flat = 0, num_flat = 1;
    for (const SeenPixel& pixel : pixels_) {
      const double share = corner.At(pixel).share;
      const double off = (p[kLight] - pixel.level) / (p[kLight] - p[kDark]) - share;
      const bool is_flat = share < kFlat || share > 1 - kFlat;
      (is_flat ? flat : edge) += off * off;
      (is_flat ? num_flat : num_edge) += 1;
    }
    const double by_chance = 3 * std::sqrt(2 / num_edge);
    return edge / num_edge > flat / num_flat * (1 + by_chance) + misfit * misfit;
  }

 private:
  Fitted Solve(const Parameters& start, bool has_shelf) const {
    Fitted fitted{.at = start};
    double* const p = fitted.at.data();
    ceres::Problem problem;
    problem.AddResidualBlock(new LikeCorner(pixels_, guess_), nullptr, p);
    const auto bound = [&](int parameter, double low, double high) {
      problem.SetParameterLowerBound(p, parameter, low);
      problem.SetParameterUpperBound(p, parameter, high);
    };
    bound(kShelfSquared, kLeastSquared, guess_.farthest * guess_.farthest);
    bound(kAngle, -0.1, 1.45);  // a bare top as far as the tilt is off; a wall
    bound(kBlur, 0.6 * guess_.blur, 1.6 * guess_.blur);
    if (!has_shelf) {
      problem.SetManifold(p, new ceres::SubsetManifold(kNumParameters, {kShelfSquared}));
    }
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 12;  // mostly four do; a bare top tells no slope
    options.function_tolerance = 1e-5;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // the sums keep their order
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    fitted.squares = 2 * summary.final_cost;
    return fitted;
  }

  const std::vector<SeenPixel>& pixels_;
  const CornerGuess& guess_;
};

}  // namespace

std::optional<double> FitTop(const std::vector<SeenPixel>& pixels, const CornerGuess& guess) {
  constexpr double kGain = 5;        // in squares over the noise's that a shelf must bring [-]
  constexpr double kOffSide = 0.25;  // of the blur: farther out, powder hangs over the rim
  if (pixels.size() <= kNumParameters) return std::nullopt;
  const CornerFit fit(pixels, guess);
  const Fitted shelf = fit.WithShelf();
  if (fit.IsPoor(shelf.at)) return std::nullopt;
  const Fitted rim = fit.AtRim(shelf.at);
  const double noise = shelf.squares / static_cast<double>(pixels.size() - kNumParameters);
  const Parameters& best = (rim.squares - shelf.squares > kGain * noise ? shelf : rim).at;
  const bool is_off = std::abs(best[kSide]) > kOffSide * std::max(1.0, guess.blur);
  if (is_off || fit.IsPoor(best)) return std::nullopt;
  return fit.Top(best);
}

}  // namespace talus::imaging
