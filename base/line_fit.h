// The least-squares line through points that come one by one.
#pragma once

#include <algorithm>
#include <cmath>

namespace talus::base {

struct StraightLine {
  double at_zero = 0;
  double slope = 0;

  double At(double x) const { return at_zero + slope * x; }
};

// Means and squared deviations are updated with each point, so that points far from zero lose no
// digits (Welford).
class LineFit {
 public:
  void Add(double x, double y) {
    ++count_;
    const double dx = x - mean_x_;
    const double dy = y - mean_y_;
    mean_x_ += dx / count_;
    mean_y_ += dy / count_;
    sxx_ += dx * (x - mean_x_);
    sxy_ += dx * (y - mean_y_);
    syy_ += dy * (y - mean_y_);
  }

  int Count() const { return count_; }
  bool IsDetermined() const { return sxx_ > 0; }  // two points at least differ in x
  double Slope() const { return sxy_ / sxx_; }    // NaN unless it is determined
  StraightLine Line() const { return {.at_zero = mean_y_ - Slope() * mean_x_, .slope = Slope()}; }
  double Squares() const { return syy_ - Slope() * sxy_; }  // of the points' distances in y, summed
  double Rms() const { return std::sqrt(std::max(0.0, Squares()) / count_); }
  // y of the best line of another slope: it goes through the points' centre, too.
  double At(double x, double slope) const { return mean_y_ + slope * (x - mean_x_); }

 private:
  int count_ = 0;
  double mean_x_ = 0;
  double mean_y_ = 0;
  double sxx_ = 0;
  double sxy_ = 0;
  double syy_ = 0;
};

}  // namespace talus::base
