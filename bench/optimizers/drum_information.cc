// drum_information FOLDER [--modes K] [--subset N] [--every N]: what one, two and three speeds of a
// drum tell of the powder, with every simulated image in turn taken for the measured one, and
// whether the expected bits choose the next measurement well.
//
// FOLDER holds parameters.csv and images_NNrpm.u8: 50 x 50 bytes a row of the table, 0 to 16. The
// unknown are the cells of sliding friction, rolling friction and cohesion; restitution is summed
// out. Each output (a mode of the images of one speed, or the slope of its surface) is a process
// over the four parameters; a set is predicted without its own images and without those of the
// truth, so that the truth is one set among others. The likelihood is the program's own:
// joint_misfit.h; so are the expected bits: expected_learning.h.
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "optimizer/fidelity/joint_misfit.h"
#include "optimizer/information/expected_learning.h"
#include "surrogate/fidelity/fidelity_process.h"
#include "surrogate/images/principal_modes.h"
#include "surrogate/process/warp.h"

namespace talus::bench {
namespace {

constexpr int kSide = 50;
constexpr double kLevels = 16;
constexpr std::array<int, 3> kSpeeds{10, 30, 50};
constexpr double kCaution = 1.5;  // as experiment_model.cc inflates the surrogate's sd
constexpr double kRegion = 0.95;

struct Options {
  std::filesystem::path folder;
  int modes = 8;
  int subset = 294;  // rows that hyper-parameters are fitted on
  int every = 5;     // truths of the choice of the next measurement
};

struct Table {
  Eigen::MatrixXd sets;   // 4 × n, unit cube
  std::vector<int> cell;  // of each set: all but restitution
  int num_cells = 0;
};

// One output at every set.
class Output {
 public:
  Output(const surrogate::FidelityState& state, const Eigen::MatrixXd& sets,
         const Eigen::VectorXd& values)
      : values_(values) {
    const surrogate::FidelityHyper& hyper = state.hyper;
    const Eigen::MatrixXd warped = surrogate::WarpAll(sets, hyper.warp);
    const double units = state.scale * state.scale;
    noise_ = units * (hyper.noise[0] * hyper.noise[0] + 1e-10);
    Eigen::MatrixXd k(sets.cols(), sets.cols());
    for (Eigen::Index j = 0; j < k.cols(); ++j) {
      for (Eigen::Index i = 0; i < k.rows(); ++i) {
        const auto pair =
            surrogate::FidelityPair::Of(hyper, warped.col(i).data(), warped.col(j).data());
        k(i, j) = units * surrogate::FidelityCovarianceOf(hyper, pair, 0);
      }
      k(j, j) += noise_;
    }
    precision_ = k.llt().solve(Eigen::MatrixXd::Identity(k.rows(), k.cols()));
    alpha_ = precision_ * (values.array() - state.centre).matrix();
  }

  // Each set's output, predicted without the images of that set and of the truth: from the inverse
  // Q of the covariance, of which two rows and columns are taken away.
  surrogate::Predictions Without(Eigen::Index truth) const {
    const Eigen::ArrayXd own = precision_.diagonal();
    const Eigen::ArrayXd shared = precision_.col(truth);
    const double of_truth = precision_(truth, truth);
    const Eigen::ArrayXd determinant = of_truth * own - shared.square();
    surrogate::Predictions at;
    at.mean = values_.array() - (of_truth * alpha_.array() - alpha_[truth] * shared) / determinant;
    at.variance = of_truth / determinant - noise_;
    at.mean[truth] = values_[truth] - alpha_[truth] / of_truth;
    at.variance[truth] = 1 / of_truth - noise_;
    at.variance = at.variance.cwiseMax(0);
    return at;
  }
  // (value - prediction)/sd of each set from all others.
  Eigen::VectorXd Residuals() const {
    return alpha_.array() / precision_.diagonal().array().sqrt();
  }

  Eigen::Index size() const { return values_.size(); }
  double value(Eigen::Index set) const { return values_[set]; }
  double noise() const { return noise_; }  // variance of one image

 private:
  Eigen::VectorXd values_;
  double noise_ = 0;
  Eigen::MatrixXd precision_;
  Eigen::VectorXd alpha_;
};

struct Measurement {
  std::string name;
  std::vector<Output> outputs{};

  Eigen::Index size() const { return static_cast<Eigen::Index>(outputs.size()); }
};

Table ReadTable(const std::filesystem::path& folder) {
  std::ifstream file(folder / "parameters.csv");
  std::string line;
  std::getline(file, line);
  std::vector<std::array<double, 4>> rows;
  while (std::getline(file, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    double row = 0;
    std::array<double, 4> set{};
    text >> row >> set[0] >> set[1] >> set[2] >> set[3];
    rows.push_back(set);
  }
  Table table;
  table.sets.resize(4, static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < 4; ++k) {
    double high = 0;
    for (const auto& set : rows) high = std::max(high, set[k]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      table.sets(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(i)) = rows[i][k] / high;
    }
  }
  std::map<std::array<double, 3>, int> cells;
  for (const auto& set : rows) {
    const auto size = static_cast<int>(cells.size());
    table.cell.push_back(cells.try_emplace({set[1], set[2], set[3]}, size).first->second);
  }
  table.num_cells = static_cast<int>(cells.size());
  return table;
}

Eigen::MatrixXd ReadImages(const std::filesystem::path& folder, int speed, Eigen::Index count) {
  std::ifstream file(folder / ("images_" + std::to_string(speed) + "rpm.u8"), std::ios::binary);
  Eigen::MatrixXd images(count, kSide * kSide);
  std::vector<char> bytes(kSide * kSide);
  for (Eigen::Index i = 0; i < count; ++i) {
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    for (Eigen::Index k = 0; k < images.cols(); ++k) {
      images(i, k) = static_cast<std::uint8_t>(bytes[static_cast<std::size_t>(k)]) / kLevels;
    }
  }
  if (!file) {
    std::fprintf(stderr, "cannot read the images of %d rpm\n", speed);
    std::exit(1);
  }
  return images;
}

// Slope of the line that divides powder from air, [-]: the direction of the powder's first moment.
double SlopeOf(const Eigen::RowVectorXd& image) {
  double x = 0;
  double y = 0;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const double powder = image[row * kSide + column];
      x += powder * (column + 0.5 - 0.5 * kSide);
      y += powder * (row + 0.5 - 0.5 * kSide);
    }
  }
  return std::atan2(x, y);
}

// Hyper-parameters from a subset, spread over the table.
Measurement Learnt(const std::string& name, const Table& table, const Eigen::MatrixXd& values,
                   int subset) {
  const Eigen::Index n = values.rows();
  Measurement m{.name = name};
  std::vector<Eigen::Index> some;
  for (Eigen::Index i = 0; i < subset; ++i) some.push_back((i * 617) % n);  // prime to n
  const surrogate::FidelityFitOptions options{.noise_median = Eigen::VectorXd::Constant(1, 0.2)};
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    const surrogate::FidelityData data{.points = table.sets(Eigen::all, some),
                                       .growth = Eigen::VectorXd::Zero(subset),
                                       .level = Eigen::VectorXi::Zero(subset),
                                       .values = values.col(k)(some)};
    m.outputs.emplace_back(surrogate::FidelityProcess::Fit(data, options).state(), table.sets,
                           values.col(k));
  }
  return m;
}

// The likelihood of some measurements together, of every set with every set for the truth.
class Likelihood {
 public:
  Likelihood(const std::vector<const Measurement*>& parts, bool joint) {
    if (joint) {
      groups_.push_back(GroupOf(parts));
      return;
    }
    for (const Measurement* m : parts) groups_.push_back(GroupOf({m}));
  }

  // ln p of every set when the images of set `truth` were measured.
  Eigen::VectorXd At(Eigen::Index truth, double softness) const {
    Eigen::VectorXd density = Eigen::VectorXd::Zero(groups_.front().squared.rows());
    for (const Group& g : groups_) {
      density += g.misfit.LogDensity(g.squared.col(truth), g.log_sd.col(truth), softness);
    }
    return density;
  }
  double temper() const { return groups_.front().misfit.temper(); }

 private:
  struct Group {
    optimizer::JointMisfit misfit;
    Eigen::MatrixXd squared;  // one truth a column
    Eigen::MatrixXd log_sd;
  };

  static Group GroupOf(const std::vector<const Measurement*>& parts) {
    Group group{.misfit = MisfitOf(parts), .squared = {}, .log_sd = {}};
    const Eigen::Index n = parts.front()->outputs.front().size();
    group.squared.resize(n, n);
    group.log_sd.setZero(n, n);
    Eigen::MatrixXd residual(n, group.misfit.num_outputs());
    for (Eigen::Index truth = 0; truth < n; ++truth) {
      Eigen::Index column = 0;
      for (const Measurement* m : parts) {
        for (const Output& output : m->outputs) {
          const surrogate::Predictions at = output.Without(truth);
          residual.col(column++) =
              (output.value(truth) - at.mean.array()) /
              (kCaution * kCaution * at.variance.array() + output.noise()).sqrt();
          group.log_sd.col(truth).array() += 0.5 * (at.variance.array() + output.noise()).log();
        }
      }
      group.squared.col(truth) = group.misfit.Squared(residual);
    }
    return group;
  }
  static optimizer::JointMisfit MisfitOf(const std::vector<const Measurement*>& parts) {
    Eigen::MatrixXd stacked;
    std::vector<int> test;
    for (std::size_t e = 0; e < parts.size(); ++e) {
      for (const Output& output : parts[e]->outputs) {
        const Eigen::VectorXd z = output.Residuals();
        stacked.conservativeResize(z.size(), stacked.cols() + 1);
        stacked.rightCols(1) = z;
        test.push_back(static_cast<int>(e));
      }
    }
    return {stacked, test};
  }

  std::vector<Group> groups_;
};

Eigen::VectorXd Probability(const Eigen::VectorXd& log_density) {
  Eigen::VectorXd p = (log_density.array() - log_density.maxCoeff()).exp();
  return p / p.sum();
}

Eigen::VectorXd CellsOf(const Table& table, const Eigen::VectorXd& of_sets) {
  Eigen::VectorXd p = Eigen::VectorXd::Zero(table.num_cells);
  for (std::size_t i = 0; i < table.cell.size(); ++i) {
    p[table.cell[i]] += of_sets[static_cast<Eigen::Index>(i)];
  }
  return p;
}

// Against an even prior over the cells.
double Bits(const Eigen::VectorXd& p) {
  double entropy = 0;
  for (const double share : p) {
    if (share > 0) entropy -= share * std::log2(share);
  }
  return std::log2(static_cast<double>(p.size())) - entropy;
}

double Quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

double Mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

// The smallest set of cells with this probability, and whether it holds the truth.
std::pair<int, bool> Tied(const Eigen::VectorXd& p, int truth) {
  std::vector<int> order(static_cast<std::size_t>(p.size()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return p[a] > p[b]; });
  double sum = 0;
  bool holds = false;
  int count = 0;
  for (const int cell : order) {
    ++count;
    holds |= cell == truth;
    if ((sum += p[cell]) >= kRegion) break;
  }
  return {count, holds};
}

struct Told {
  double bits = 0;
  double tied = 0;
  bool holds = false;
};

Told ToldOf(const Table& table, const Likelihood& likelihood, Eigen::Index truth, double softness) {
  const Eigen::VectorXd p = CellsOf(table, Probability(likelihood.At(truth, softness)));
  const auto [count, holds] = Tied(p, table.cell[static_cast<std::size_t>(truth)]);
  return {.bits = Bits(p), .tied = static_cast<double>(count), .holds = holds};
}

// The least softness with which the sets of 95 % hold the truth in 95 % of every other case, from
// `first`.
double SoftnessOf(const Table& table, const Likelihood& likelihood, Eigen::Index first) {
  double low = 1;
  double high = 16;
  for (int step = 0; step < 7; ++step) {
    const double middle = std::sqrt(low * high);
    int covered = 0;
    int count = 0;
    for (Eigen::Index truth = first; truth < table.sets.cols(); truth += 2, ++count) {
      covered += ToldOf(table, likelihood, truth, middle).holds ? 1 : 0;
    }
    (covered >= kRegion * count ? high : low) = middle;
  }
  return high;
}

// Of each half of the truths, even and odd ones, from the other half.
std::array<double, 2> Softness(const Table& table, const Likelihood& likelihood) {
  return {SoftnessOf(table, likelihood, 1), SoftnessOf(table, likelihood, 0)};
}

void PrintRow(const Table& table, const std::string& name, const Likelihood& likelihood,
              const std::array<double, 2>& softness) {
  std::vector<double> bits;
  std::vector<double> tied;
  double covered = 0;
  for (Eigen::Index truth = 0; truth < table.sets.cols(); ++truth) {
    const Told told =
        ToldOf(table, likelihood, truth, softness[static_cast<std::size_t>(truth % 2)]);
    bits.push_back(told.bits);
    tied.push_back(told.tied);
    covered += told.holds ? 1 : 0;
  }
  std::printf("%-32s %.2f bits, tied %3.0f, %3.0f, coverage %.3f, temper %.2f x %.2f\n",
              name.c_str(), Mean(bits), Quantile(tied, 0.5), Quantile(tied, 0.9),
              covered / static_cast<double>(tied.size()), likelihood.temper(),
              std::sqrt(softness[0] * softness[1]));
  std::fflush(stdout);
}

// As the outputs' coverage tempers it, then softened until the sets' coverage is right.
void PrintRows(const Table& table, const std::string& name,
               const std::vector<const Measurement*>& parts, bool joint) {
  const Likelihood likelihood(parts, joint);
  PrintRow(table, name, likelihood, {1, 1});
  PrintRow(table, "  … softened", likelihood, Softness(table, likelihood));
}

// Sets in proportion to their probability, evenly through the sum.
std::vector<Eigen::Index> DrawSets(const Eigen::VectorXd& p, int count) {
  std::vector<Eigen::Index> rows;
  Eigen::Index i = 0;
  double sum = p[0];
  for (int k = 0; k < count; ++k) {
    const double goal = (k + 0.5) / count;
    while (i + 1 < p.size() && sum < goal) sum += p[++i];
    rows.push_back(i);
  }
  return rows;
}

// Bits that a measurement is expected to give, with the draws of the posterior so far.
double Expected(const Table& table, const Measurement& m, Eigen::Index truth,
                const std::vector<Eigen::Index>& draws, double temper) {
  optimizer::PredictedMeasurement predicted{
      .mean = Eigen::MatrixXd(static_cast<Eigen::Index>(draws.size()), m.size()),
      .variance = Eigen::VectorXd(m.size())};
  for (Eigen::Index k = 0; k < m.size(); ++k) {
    const Output& output = m.outputs[static_cast<std::size_t>(k)];
    const surrogate::Predictions at = output.Without(truth);
    predicted.mean.col(k) = at.mean(draws);
    predicted.variance[k] = temper * (output.noise() + at.variance(draws).mean());
  }
  return optimizer::Learn(table.sets(Eigen::all, draws).transpose(), predicted, 1).bits;
}

// A likelihood that covers.
struct Softened {
  Likelihood likelihood;
  std::array<double, 2> softness{};

  Softened(const Table& table, const std::vector<const Measurement*>& parts)
      : likelihood(parts, true), softness(Softness(table, likelihood)) {}
  double Of(Eigen::Index truth) const { return softness[static_cast<std::size_t>(truth % 2)]; }
  Eigen::VectorXd At(Eigen::Index truth) const {
    return Probability(likelihood.At(truth, Of(truth)));
  }
};

// After the images of speed `first`: which other image or slope is measured next.
void PrintChoice(const Table& table, const std::vector<Measurement>& all, std::size_t first,
                 int every) {
  constexpr int kDraws = 300;
  const Softened before(table, {&all[first]});
  std::vector<const Measurement*> next;
  std::vector<Softened> after;
  for (const Measurement& m : all) {
    if (&m == &all[first]) continue;
    next.push_back(&m);
    after.emplace_back(table, std::vector<const Measurement*>{&all[first], &m});
  }
  std::vector<double> chosen;
  std::vector<double> hindsight;
  std::vector<double> random;
  for (Eigen::Index truth = 0; truth < table.sets.cols(); truth += every) {
    const Eigen::VectorXd p = before.At(truth);
    const std::vector<Eigen::Index> rows = DrawSets(p, kDraws);
    const double temper = before.likelihood.temper() * before.Of(truth);
    const double known = Bits(CellsOf(table, p));
    std::vector<double> expected;
    std::vector<double> gains;
    for (std::size_t c = 0; c < next.size(); ++c) {
      expected.push_back(Expected(table, *next[c], truth, rows, temper));
      gains.push_back(Bits(CellsOf(table, after[c].At(truth))) - known);
    }
    const auto most = std::max_element(expected.begin(), expected.end()) - expected.begin();
    chosen.push_back(gains[static_cast<std::size_t>(most)]);
    hindsight.push_back(*std::max_element(gains.begin(), gains.end()));
    random.push_back(Mean(gains));
  }
  std::printf("next after %s realises %.2f bits, %.0f %% of hindsight's %.2f; at random %.2f\n",
              all[first].name.c_str(), Mean(chosen), 100 * Mean(chosen) / Mean(hindsight),
              Mean(hindsight), Mean(random));
  std::fflush(stdout);
}

int Run(const Options& options) {
  const Table table = ReadTable(options.folder);
  std::vector<Measurement> images;
  std::vector<Measurement> slopes;
  for (const int speed : kSpeeds) {
    const Eigen::MatrixXd pixels = ReadImages(options.folder, speed, table.sets.cols());
    const surrogate::PrincipalModes modes = surrogate::FitModes(pixels, options.modes);
    const Eigen::MatrixXd values = (pixels.rowwise() - modes.mean.transpose()) * modes.basis;
    Eigen::MatrixXd slope(pixels.rows(), 1);
    for (Eigen::Index i = 0; i < pixels.rows(); ++i) slope(i, 0) = SlopeOf(pixels.row(i));
    const std::string name = std::to_string(speed) + " rpm";
    images.push_back(Learnt(name, table, values, options.subset));
    slopes.push_back(Learnt("slope " + name, table, slope, options.subset));
  }
  std::printf("%zu images a speed, %d cells, prior %.2f bits; tied: median, 90th percentile\n",
              table.cell.size(), table.num_cells, std::log2(table.num_cells));
  for (const Measurement& m : slopes) PrintRows(table, m.name, {&m}, true);
  for (const Measurement& m : images) PrintRows(table, m.name, {&m}, true);
  for (const bool joint : {false, true}) {
    const std::string how = joint ? ", joint" : ", independent";
    PrintRows(table, "10 + 50 rpm" + how, {&images[0], &images[2]}, joint);
    PrintRows(table, "10 + 30 + 50 rpm" + how, {&images[0], &images[1], &images[2]}, joint);
  }
  std::vector<Measurement> all = images;
  all.insert(all.end(), slopes.begin(), slopes.end());
  for (std::size_t first = 0; first < images.size(); ++first) {
    PrintChoice(table, all, first, options.every);
  }
  return 0;
}

}  // namespace
}  // namespace talus::bench

int main(int argc, char** argv) {
  talus::bench::Options options;
  if (argc < 2 || argc % 2 != 0) {
    std::fprintf(stderr, "usage: drum_information FOLDER [--modes K] [--subset N] [--every N]\n");
    return 2;
  }
  options.folder = argv[1];
  for (int i = 2; i + 1 < argc; i += 2) {
    const std::string key = argv[i];
    const int value = std::atoi(argv[i + 1]);
    if (key == "--modes") options.modes = value;
    if (key == "--subset") options.subset = value;
    if (key == "--every") options.every = value;
  }
  return talus::bench::Run(options);
}
