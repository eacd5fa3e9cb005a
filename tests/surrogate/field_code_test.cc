#include "surrogate/images/field_code.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "surrogate/images/normal_table.h"

namespace talus::surrogate {
namespace field_code_test {

constexpr FieldSize kSize{.width = 40, .height = 24};
const Vessel kPlate(kSize);  // along the bottom of the image

// A heap with a foot of half a pixel, where the edge is cut by the bottom of the image.
ColumnEdges Heap(double top, double width) {
  ColumnEdges edges{.height = Eigen::VectorXd(kSize.width),
                    .width = Eigen::VectorXd::Constant(kSize.width, width)};
  for (int c = 0; c < kSize.width; ++c) {
    edges.height[c] = std::max(0.5, top * (1 - std::abs(c + 0.5 - 20) / 17));
  }
  return edges;
}

double SumOfDifferences(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  }
  return sum;
}

TEST(NormalTable, IsTheNormalDistributionFunction) {
  for (double t = -7; t <= 7; t += 0.0137) {
    EXPECT_NEAR(NormalTable::Cdf(t), 0.5 * std::erfc(-t / std::sqrt(2.0)), 1e-8) << t;
  }
}

TEST(ColumnEdges, AreFoundAgainInTheirImage) {
  for (const double width : {0.8, 1.5}) {
    const ColumnEdges edges = Heap(15, width);
    const ColumnEdges found = FitEdges(Render(edges, kSize, kPlate), kSize, kPlate);
    // Pixel values are floats, and the sums over pixels stand for integrals: at 0.8 px that is off
    // by e^(-2 π² 0.64) ≈ 3e-6.
    EXPECT_LT((found.height - edges.height).cwiseAbs().maxCoeff(), 2e-3) << width;
    EXPECT_LT((found.width - edges.width).cwiseAbs().maxCoeff(), 2e-3) << width;
  }
}

TEST(ColumnEdges, EmptyAndFullImagesHaveNone) {
  const std::vector<float> empty(static_cast<std::size_t>(kSize.num_pixels()), 0.0F);
  const std::vector<float> full(static_cast<std::size_t>(kSize.num_pixels()), 1.0F);
  for (const auto& field : {empty, full}) {
    // Three widths beyond the border: 1.3e-3 of grey in each column's last pixels.
    EXPECT_LT(SumOfDifferences(Render(FitEdges(field, kSize, kPlate), kSize, kPlate), field), 0.1);
  }
}

// A wide plate has many of them. Their code is the same whatever the heap beside them is like: it
// was three widths of its edge below the plate, and said more of two heaps than the heaps did.
TEST(ColumnEdges, ColumnsWithoutPowderTellNothing) {
  ColumnEdges heap = Heap(15, 1);
  heap.height.head(10).setConstant(-20);
  for (const double width : {0.5, 1.0, 2.0}) {
    heap.width.setConstant(width);
    const ColumnEdges found = FitEdges(Render(heap, kSize, kPlate), kSize, kPlate);
    const ColumnEdges empty = FitEdges(
        std::vector<float>(static_cast<std::size_t>(kSize.num_pixels()), 0.0F), kSize, kPlate);
    EXPECT_EQ(found.height.head(10), empty.height.head(10)) << width;
    EXPECT_EQ(found.width.head(10), empty.width.head(10)) << width;
  }
}

// The code of a mean image is that of none of its heaps, until its edges are made narrower.
TEST(EdgeCode, OneOfAMeanHasTheMeanCodeOfTheHeaps) {
  constexpr int kHeaps = 400;
  constexpr double kScatter = 1;  // of the heights [px]
  base::Random random(5, base::Stream("mean image"));
  const EdgeCode code(kSize, {});
  std::vector<float> image(static_cast<std::size_t>(kSize.num_pixels()));
  Eigen::VectorXd mean_code = Eigen::VectorXd::Zero(2 * kSize.width);
  for (int i = 0; i < kHeaps; ++i) {
    ColumnEdges heap = Heap(15, 1);
    for (double& height : heap.height) height += kScatter * random.Normal();
    const auto one = Render(heap, kSize, kPlate);
    for (std::size_t p = 0; p < image.size(); ++p) image[p] += one[p] / kHeaps;
    mean_code += code.Encode(one) / kHeaps;
  }
  const Eigen::VectorXd of_mean = code.Encode(image);
  const Eigen::VectorXd variance = Eigen::VectorXd::Constant(mean_code.size(), kScatter * kScatter);
  const Eigen::VectorXd one = code.OneOfMean(of_mean, variance);
  // Whole columns only: a quarter of the image beside its middle. A variance of 400 draws is known
  // to 7 %, which is 0.035 of a width of √2, and 0.8 of widths are in the code.
  const auto widths = [](const Eigen::VectorXd& v) { return v.segment(kSize.width + 14, 12); };
  EXPECT_GT((widths(of_mean) - widths(mean_code)).minCoeff(), 0.2);
  EXPECT_LT((widths(one) - widths(mean_code)).cwiseAbs().maxCoeff(), 0.12);
  EXPECT_LT((code.MeanOfImages(one, variance) - of_mean)
                .segment(kSize.width + 14, 12)
                .cwiseAbs()
                .maxCoeff(),
            1e-9);
}

TEST(EdgeCode, SadIsThatOfTheDecodedImage) {
  const auto target = Render(Heap(15, 1), kSize, kPlate);
  const EdgeCode code(kSize, target);
  const Eigen::VectorXd vector = code.Encode(Render(Heap(12, 1.5), kSize, kPlate));
  // Pixels more than four widths from the edge count as black or white: 3e-5 each.
  EXPECT_NEAR(code.Sad(vector), SumOfDifferences(code.Decode(vector), target), 5e-3);
  EXPECT_GT(code.Sad(vector), 20);
}

// Powder in a round vessel as wide as the image, up to a surface of this slope through its middle.
std::vector<float> Drum(double slope) {
  constexpr int kSteps = 4;  // samples of a pixel, each way
  const double radius = 0.5 * kSize.width;
  std::vector<float> field(static_cast<std::size_t>(kSize.num_pixels()));
  for (int i = 0; i < kSize.num_pixels() * kSteps * kSteps; ++i) {
    const int pixel = i / (kSteps * kSteps);
    const double dx = (i % kSteps + 0.5) / kSteps;
    const double dy = (i / kSteps % kSteps + 0.5) / kSteps;
    const double x = pixel % kSize.width + dx - radius;
    const double y = kSize.height - pixel / kSize.width - dy - radius;  // up, from the middle
    if (x * x + y * y > radius * radius || y > slope * x - 5) continue;
    field[static_cast<std::size_t>(pixel)] += 1.0F / (kSteps * kSteps);
  }
  return field;
}

// What lies below the floor is black in every image, so the code of one keeps its surface alone.
TEST(EdgeCode, PowderOnARoundFloorIsKnownByItsSurface) {
  const auto target = Drum(0.2);
  const EdgeCode code(kSize, target);
  for (const double slope : {-0.1, 0.05, 0.2, 0.3}) {
    const auto field = Drum(slope);
    const Eigen::VectorXd vector = code.Encode(field);
    // The target has 500 px of powder. Standing on the bottom of the image the same heights would
    // be off by the floor, 150 px. The floor is not known where the target has no powder on it: 17
    // px at the first slope; what stands there adds to the sum of differences wherever it stands.
    EXPECT_LT(SumOfDifferences(code.Decode(vector), field), 20) << slope;
    EXPECT_NEAR(code.Sad(vector), SumOfDifferences(field, target), 12) << slope;
  }
}

TEST(Vessel, AHeapThatOverhangsInPlacesHasNoFloor) {
  auto field = Render(Heap(15, 1), kSize, kPlate);
  for (int c = 20; c < 25; ++c) {
    for (int row = 0; row < 3; ++row) {  // from the bottom
      field[static_cast<std::size_t>((kSize.height - 1 - row) * kSize.width + c)] = 0;
    }
  }
  EXPECT_EQ(Vessel(field, kSize).open(), kPlate.open());
  EXPECT_NE(Vessel(Drum(0), kSize).open(), kPlate.open());
}

// The mean over draws of the vector's elements.
double MonteCarlo(const FieldCode& code, const Eigen::VectorXd& mean,
                  const Eigen::VectorXd& variance, int num_draws) {
  base::Random random(3, base::Stream("expected sad"));
  double sum = 0;
  for (int i = 0; i < num_draws; ++i) {
    Eigen::VectorXd draw = mean;
    for (Eigen::Index k = 0; k < draw.size(); ++k) {
      draw[k] += std::sqrt(variance[k]) * random.Normal();
    }
    sum += code.Sad(draw);
  }
  return sum / num_draws;
}

TEST(EdgeCode, ExpectedSadIsTheMeanOverDrawsAndMoreThanThatOfTheMean) {
  const auto target = Render(Heap(15, 1), kSize, kPlate);
  const EdgeCode code(kSize, target);
  const Eigen::VectorXd mean = code.Encode(target);
  for (const double sd : {0.1, 0.5, 2.0}) {
    Eigen::VectorXd variance = Eigen::VectorXd::Zero(mean.size());
    variance.head(kSize.width).setConstant(sd * sd);  // of the heights; widths are taken as known
    const double expected = code.ExpectedSad(mean, variance);
    // 4000 draws of 40 columns leave 0.3 %; six nodes are off by up to 2 % where the scatter is
    // wider than what is left of a column above the bottom of the image.
    EXPECT_NEAR(expected / MonteCarlo(code, mean, variance, 4000), 1, 0.02) << sd;
    EXPECT_GT(expected, code.Sad(mean) + 0.5 * sd);
  }
}

TEST(PixelCode, ExpectedSadIsTheMeanOverDraws) {
  const auto target = Render(Heap(15, 1), kSize, kPlate);
  const PixelCode code(kSize, target);
  // Grey pixels far from 0 and 1, where no draw is cut off.
  const Eigen::VectorXd mean = (0.5 + 0.1 * (code.Encode(target).array() - 0.5)).matrix();
  const Eigen::VectorXd variance = Eigen::VectorXd::Constant(mean.size(), 0.01);
  EXPECT_NEAR(code.ExpectedSad(mean, variance) / MonteCarlo(code, mean, variance, 2000), 1, 1e-3);
}

TEST(PixelCode, LargeImagesAreAveragedInBlocksThatKeepTheSum) {
  const FieldSize size{.width = 301, .height = 203};
  std::vector<float> field(static_cast<std::size_t>(size.num_pixels()));
  base::Random random(1, base::Stream("pixels"));
  double sum = 0;
  for (float& pixel : field) sum += pixel = static_cast<float>(random.Uniform());
  const PixelCode code(size, field);
  const Eigen::VectorXd vector = code.Encode(field);
  EXPECT_LT(vector.size(), 7000);
  double decoded = 0;
  for (const float pixel : code.Decode(vector)) decoded += pixel;
  EXPECT_NEAR(decoded, sum, 1e-3 * sum);  // floats
  EXPECT_NEAR(code.Sad(vector), 0, 1e-9);
}

}  // namespace field_code_test
}  // namespace talus::surrogate
