// drum_information FOLDER [--modes K] [--subset N] [--every N]: what one, two and three speeds of a
// drum tell of the powder, with every simulated image in turn taken for the measured one, and
// whether the expected bits choose the next measurement well.
//
// FOLDER holds parameters.csv and images_NNrpm.u8: 50 x 50 bytes a row of the table, 0 to 16. The
// unknown are the cells of sliding friction, rolling friction and cohesion; restitution is summed
// out. Each output (a mode of the images of one speed, or the slope of its surface) is a process
// over the four parameters; a set is predicted from all others, as the reference in the table's
// README does, so that the truth is one set among others. The likelihood is the program's own:
// joint_misfit.h; so are the expected bits: expected_learning.h.
//
// Rows as the program tempers: misfits are divided by what makes the regions of the outputs right.
// Rows below, "to coverage": the whole likelihood instead is raised to the power with which the 95
// % sets of cells hold the truth in 95 % of cases, each half of the truths by the other half. "A
// Student-t" has the tails of the reference's likelihood in place of the program's
// (robust_misfit.h).
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/optimizers/drum_likelihood.h"
#include "optimizer/posterior/expected_learning.h"
#include "surrogate/images/principal_modes.h"

namespace talus::bench {
namespace {

constexpr std::array<int, 3> kSpeeds{10, 30, 50};
constexpr double kRegion = 0.95;

struct Options {
  std::filesystem::path folder;
  int modes = 12;
  int subset = 392;  // rows that hyper-parameters are fitted on
  int every = 5;     // truths of the choice of the next measurement
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

Told ToldOf(const Table& table, const Likelihood& likelihood, Eigen::Index truth,
            const Reading& reading) {
  const Eigen::VectorXd p = CellsOf(table, Probability(likelihood.At(truth, reading)));
  const auto [count, holds] = Tied(p, table.cell[static_cast<std::size_t>(truth)]);
  return {.bits = Bits(p), .tied = static_cast<double>(count), .holds = holds};
}

// The largest power with which the sets of 95 % hold the truth in 95 % of every other case, from
// `first`.
double PowerOf(const Table& table, const Likelihood& likelihood, bool student, Eigen::Index first) {
  double low = 0.05;
  double high = 1;
  for (int step = 0; step < 8; ++step) {
    const double middle = std::sqrt(low * high);
    int covered = 0;
    int count = 0;
    for (Eigen::Index truth = first; truth < table.sets.cols(); truth += 2, ++count) {
      covered += ToldOf(table, likelihood, truth, {middle, student}).holds ? 1 : 0;
    }
    (covered >= kRegion * count ? low : high) = middle;
  }
  return low;
}

// Readings of even and odd truths, each from the others.
using Readings = std::array<Reading, 2>;

Readings Covering(const Table& table, const Likelihood& likelihood, bool student = false) {
  return {Reading{PowerOf(table, likelihood, student, 1), student},
          Reading{PowerOf(table, likelihood, student, 0), student}};
}

void PrintRow(const Table& table, const std::string& name, const Likelihood& likelihood,
              const Readings& readings) {
  std::vector<double> bits;
  std::vector<double> tied;
  double covered = 0;
  for (Eigen::Index truth = 0; truth < table.sets.cols(); ++truth) {
    const Told told =
        ToldOf(table, likelihood, truth, readings[static_cast<std::size_t>(truth % 2)]);
    bits.push_back(told.bits);
    tied.push_back(told.tied);
    covered += told.holds ? 1 : 0;
  }
  std::printf("%-32s %.2f bits, tied %3.0f, %3.0f, coverage %.3f, ", name.c_str(), Mean(bits),
              Quantile(tied, 0.5), Quantile(tied, 0.9), covered / static_cast<double>(tied.size()));
  if (readings[0].power) {
    std::printf("powers %.2f, %.2f\n", *readings[0].power, *readings[1].power);
  } else {
    std::printf("temper %.2f\n", likelihood.temper());
  }
  std::fflush(stdout);
}

void PrintRows(const Table& table, const std::string& name,
               const std::vector<const Measurement*>& parts, bool joint) {
  const Likelihood likelihood(parts, joint);
  PrintRow(table, name, likelihood, {});
  PrintRow(table, "  to coverage", likelihood, Covering(table, likelihood));
  PrintRow(table, "  a Student-t, to coverage", likelihood, Covering(table, likelihood, true));
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
double Expected(const Table& table, const Measurement& m, const std::vector<Eigen::Index>& draws,
                double temper) {
  optimizer::PredictedMeasurement predicted{
      .mean = Eigen::MatrixXd(static_cast<Eigen::Index>(draws.size()), m.size()),
      .variance = Eigen::VectorXd(m.size())};
  for (Eigen::Index k = 0; k < m.size(); ++k) {
    const Output& output = m.outputs[static_cast<std::size_t>(k)];
    const surrogate::Predictions at = output.LeftOut();
    predicted.mean.col(k) = at.mean(draws);
    predicted.variance[k] = temper * (output.noise() + at.variance(draws).mean());
  }
  return optimizer::Learn(table.sets(Eigen::all, draws).transpose(), predicted, 1).bits;
}

// A likelihood whose sets cover.
struct CoveringLikelihood {
  Likelihood likelihood;
  Readings readings;

  CoveringLikelihood(const Table& table, const std::vector<const Measurement*>& parts)
      : likelihood(parts, true), readings(Covering(table, likelihood)) {}
  const Reading& Of(Eigen::Index truth) const {
    return readings[static_cast<std::size_t>(truth % 2)];
  }
  Eigen::VectorXd At(Eigen::Index truth) const {
    return Probability(likelihood.At(truth, Of(truth)));
  }
};

// After the images of speed `first`: which other image or slope is measured next.
void PrintChoice(const Table& table, const std::vector<Measurement>& all, std::size_t first,
                 int every) {
  constexpr int kDraws = 300;
  const CoveringLikelihood before(table, {&all[first]});
  std::vector<const Measurement*> next;
  std::vector<CoveringLikelihood> after;
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
    const double temper = 1 / *before.Of(truth).power;
    const double known = Bits(CellsOf(table, p));
    std::vector<double> expected;
    std::vector<double> gains;
    for (std::size_t c = 0; c < next.size(); ++c) {
      expected.push_back(Expected(table, *next[c], rows, temper));
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
    const surrogate::PrincipalModes modes =
        surrogate::FitModes(pixels, Eigen::VectorXd::Ones(pixels.rows()), options.modes);
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
