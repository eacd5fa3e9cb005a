#include "imaging/light/backlight.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"

namespace talus::imaging {
namespace {

constexpr int kLongestSide = 100;        // of the thinned picture that the background is fitted on
constexpr double kBlackest = 12;         // a picture without brighter pixels is black [grey levels]
constexpr double kLeastContrast = 0.15;  // of powder and plate to the background [-]
constexpr double kFaintest = 0.03;       // of the background, over its maximum
constexpr double kDarkBorder = 0.9;      // share of the upper border in a front-lit picture [-]
constexpr double kSurelyLight = 0.8;     // relative brightness that the last rounds ask for

// Terms x^i y^j with i + j <= degree.
constexpr std::size_t kMostTerms = 15;
constexpr int NumTerms(int degree) { return (degree + 1) * (degree + 2) / 2; }

std::array<double, kMostTerms> Terms(double x, double y, int degree) {
  std::array<double, kMostTerms> terms{1};
  std::size_t count = 1;
  for (int total = 1; total <= degree; ++total) {  // each row from the one before: x times, y times
    const std::size_t row = count - static_cast<std::size_t>(total);
    for (std::size_t i = 0; i < static_cast<std::size_t>(total); ++i) {
      terms[count++] = x * terms[row + i];
    }
    terms[count] = y * terms[count - static_cast<std::size_t>(total) - 1];
    ++count;
  }
  return terms;
}

// Means of square blocks: the light varies slowly, and the noise averages out.
struct Thinned {
  int block = 1;  // [px]
  RelativeImage image;
};

Thinned Thin(const GrayImage& photo) {
  Thinned thin;
  thin.block = std::max(1, std::max(photo.width, photo.height) / kLongestSide);
  thin.image.width = std::max(1, photo.width / thin.block);
  thin.image.height = std::max(1, photo.height / thin.block);
  const int block_x = std::min(thin.block, photo.width);
  const int block_y = std::min(thin.block, photo.height);
  for (int y = 0; y < thin.image.height; ++y) {
    for (int x = 0; x < thin.image.width; ++x) {
      double sum = 0;
      for (int j = 0; j < block_y; ++j) {
        for (int i = 0; i < block_x; ++i) sum += photo.at(x * thin.block + i, y * thin.block + j);
      }
      thin.image.pixels.push_back(static_cast<float>(sum / block_x / block_y));
    }
  }
  return thin;
}

// In coordinates that run from -1 to 1 across the picture.
class Background {
 public:
  Background(const RelativeImage& image, const std::vector<bool>& light, int degree)
      : degree_(degree), coefficients_(Eigen::VectorXd::Zero(NumTerms(degree))) {
    const int n = NumTerms(degree);
    Eigen::MatrixXd normal = Eigen::MatrixXd::Identity(n, n) * 1e-9;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
    std::size_t pixel = 0;
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x, ++pixel) {
        if (!light[pixel]) continue;
        const auto terms =
            Terms(Normalised(x + 0.5, image.width), Normalised(y + 0.5, image.height), degree);
        const Eigen::Map<const Eigen::VectorXd> row(terms.data(), n);
        normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
        right += row * static_cast<double>(image.pixels[pixel]);
      }
    }
    coefficients_ = normal.selfadjointView<Eigen::Lower>().ldlt().solve(right);
  }

  static double Normalised(double at, int size) { return 2 * at / size - 1; }

  double At(double x, double y) const {
    const auto terms = Terms(x, y, degree_);
    return coefficients_.dot(Eigen::Map<const Eigen::VectorXd>(terms.data(), coefficients_.size()));
  }

 private:
  int degree_;
  Eigen::VectorXd coefficients_;
};

std::vector<float> Relative(const RelativeImage& image, const Background& background) {
  std::vector<float> relative;
  relative.reserve(image.pixels.size());
  double brightest = 0;
  for (const float level : image.pixels)
    brightest = std::max(brightest, static_cast<double>(level));
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double light = background.At(Background::Normalised(x + 0.5, image.width),
                                         Background::Normalised(y + 0.5, image.height));
      relative.push_back(
          static_cast<float>(image.at(x, y) / std::max(light, kFaintest * brightest)));
    }
  }
  return relative;
}

Background FitBackground(const RelativeImage& image) {
  std::vector<float> relative = image.pixels;
  double above = SplitByOtsu(relative).middle();
  Background background(image, std::vector<bool>(image.pixels.size(), true), 0);
  for (const int degree : {1, 2, 2, 4, 4, 4}) {
    std::vector<bool> light(relative.size());
    for (std::size_t i = 0; i < light.size(); ++i) light[i] = relative[i] > above;
    background = Background(image, light, degree);
    relative = Relative(image, background);
    above = SplitByOtsu(relative).middle();
    if (degree == 4) above = std::max(above, kSurelyLight);
  }
  return background;
}

// The background is linear between every kStep-th column: as good as the polynomial and quicker.
RelativeImage Divide(const GrayImage& photo, const Background& background) {
  RelativeImage image{.width = photo.width, .height = photo.height, .pixels = {}};
  image.pixels.reserve(photo.pixels.size());
  std::vector<double> coarse;  // background at every kStep-th column of a row
  constexpr int kStep = 16;
  const auto light = [&](int x, int y) {
    return std::max(background.At(Background::Normalised(x + 0.5, photo.width),
                                  Background::Normalised(y + 0.5, photo.height)),
                    255 * kFaintest);
  };
  for (int y = 0; y < photo.height; ++y) {
    coarse.clear();
    for (int x = 0; x < photo.width + kStep; x += kStep) coarse.push_back(light(x, y));
    for (int x = 0; x < photo.width; ++x) {
      const auto cell = static_cast<std::size_t>(x / kStep);
      const double share = static_cast<double>(x % kStep) / kStep;
      const double here = coarse[cell] + share * (coarse[cell + 1] - coarse[cell]);
      image.pixels.push_back(static_cast<float>(photo.at(x, y) / here));
    }
  }
  return image;
}

// The upper border, which heap and plate leave free: the top row, and the sides' upper half.
std::vector<float> UpperBorder(const RelativeImage& image) {
  std::vector<float> border(image.pixels.begin(), image.pixels.begin() + image.width);
  for (int y = 1; y < image.height / 2; ++y) {
    const auto row = image.pixels.begin() + y * image.width;
    border.push_back(row[0]);
    border.push_back(row[image.width - 1]);
  }
  return border;
}

bool LooksFrontLit(const GrayImage& photo) {
  const RelativeImage thin = Thin(photo).image;
  const TwoClasses classes = SplitByOtsu(thin.pixels);
  if (classes.light - classes.dark < kLeastContrast * 255) return false;
  const std::vector<float> border = UpperBorder(thin);
  const auto dark = std::count_if(border.begin(), border.end(),
                                  [&](float level) { return level < classes.middle(); });
  return static_cast<double>(dark) > kDarkBorder * static_cast<double>(border.size());
}

// The share of the pixels lighter than mid-grey that are at full white [-].
double ShareOverexposed(const GrayImage& photo) {
  const auto light = std::count_if(photo.pixels.begin(), photo.pixels.end(),
                                   [](std::uint8_t level) { return level >= 128; });
  const auto white = std::count(photo.pixels.begin(), photo.pixels.end(), 255);
  return light > 0 ? static_cast<double>(white) / static_cast<double>(light) : 0;
}

GrayImage Negative(const GrayImage& photo) {
  GrayImage negative = photo;
  for (std::uint8_t& level : negative.pixels) level = static_cast<std::uint8_t>(255 - level);
  return negative;
}

// Where the table reaches across the whole picture, with a margin; the height where it does not.
// A few hot pixels do not make a row another one, and no row of a tilted table that the margin does
// not cover.
int FirstTableRow(const GrayImage& photo, PowderLook look) {
  constexpr int kMargin = 4;          // [px]
  constexpr double kMostHot = 0.005;  // of a row
  const std::vector<float> levels(photo.pixels.begin(), photo.pixels.end());
  const double middle = SplitByOtsu(levels).middle();
  const auto num_dark = [&](int y) {
    int count = 0;
    for (int x = 0; x < photo.width; ++x) count += photo.at(x, y) < middle;
    return count;
  };
  const bool bright = look == PowderLook::kBright ||
                      (look == PowderLook::kAuto && num_dark(photo.height - 1) * 2 < photo.width);
  const auto all = [&](int y) {
    const int other = bright ? num_dark(y) : photo.width - num_dark(y);
    return other <= kMostHot * photo.width;
  };
  int row = photo.height;
  while (row > 0 && all(row - 1)) --row;
  return std::min(row + kMargin, photo.height);
}

GrayImage UpperRows(const GrayImage& photo, int num_rows) {
  GrayImage upper = photo;
  upper.height = num_rows;
  upper.pixels.resize(static_cast<std::size_t>(upper.width) * static_cast<std::size_t>(num_rows));
  return upper;
}

// `seen` is the photograph, or its negative.
double LevelOfLight(const GrayImage& seen, const BacklitPhoto& flat, double middle) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    const bool is_lit = (flat.image.pixels[i] < middle) == flat.negative;
    if (!is_lit) continue;
    sum += flat.negative ? 255 - seen.pixels[i] : seen.pixels[i];
    count += 1;
  }
  return count > 0 ? sum / count : 0;
}

BacklitPhoto FlattenBackground(const GrayImage& photo, const LightOptions& light,
                               const std::string& name) {
  const auto brightest = *std::max_element(photo.pixels.begin(), photo.pixels.end());
  if (brightest < kBlackest) {
    throw base::ConfigError(name +
                            ": is black everywhere; take the photograph again with the "
                            "light behind the heap switched on");
  }
  BacklitPhoto flat;
  flat.negative = light.powder == PowderLook::kBright ||
                  (light.powder == PowderLook::kAuto && LooksFrontLit(photo));
  const GrayImage seen = flat.negative ? Negative(photo) : photo;
  flat.image = Divide(seen, FitBackground(Thin(seen).image));
  const TwoClasses classes = SplitByOtsu(flat.image.pixels);
  if (classes.light - classes.dark < kLeastContrast) {
    throw base::ConfigError(name +
                            ": shows nothing darker than its background (nothing brighter, "
                            "if it is lit from the front); check that heap "
                            "and plate are in the picture, with the light behind them");
  }
  flat.threshold = light.threshold.value_or(classes.middle());
  flat.light = LevelOfLight(seen, flat, classes.middle());
  return flat;
}

}  // namespace

TwoClasses SplitByOtsu(const std::vector<float>& values) {
  constexpr std::size_t kBins = 512;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double range = std::max(static_cast<double>(*high) - *low, 1e-9);
  std::array<double, kBins> count{};
  std::array<double, kBins> sum{};
  double total = 0;
  for (const float value : values) {
    const auto bin = static_cast<std::size_t>((value - *low) / range * (kBins - 1));
    count[bin] += 1;
    sum[bin] += value;
    total += value;
  }
  TwoClasses best{.dark = *low, .light = *high};
  double best_variance = -1;
  double dark_count = 0;
  double dark_sum = 0;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    dark_count += count[bin];
    dark_sum += sum[bin];
    const double light_count = static_cast<double>(values.size()) - dark_count;
    if (!(dark_count > 0) || !(light_count > 0)) continue;
    const TwoClasses classes{.dark = dark_sum / dark_count,
                             .light = (total - dark_sum) / light_count};
    const double gap = classes.light - classes.dark;
    const double variance = dark_count * light_count * gap * gap;
    if (variance > best_variance) {
      best_variance = variance;
      best = classes;
    }
  }
  return best;
}

BacklitPhoto FlattenPhoto(const GrayImage& photo, const LightOptions& light,
                          const std::string& name) {
  const int num_rows = light.table ? FirstTableRow(photo, light.powder) : photo.height;
  BacklitPhoto flat = FlattenBackground(UpperRows(photo, num_rows), light, name);
  flat.image.height = photo.height;
  flat.image.pixels.resize(photo.pixels.size(), 0.0F);
  flat.overexposed = flat.negative ? 0 : ShareOverexposed(photo);
  return flat;
}

}  // namespace talus::imaging
