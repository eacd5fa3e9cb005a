#include "optimizer/search/image_history.h"

#include <algorithm>
#include <cmath>

#include "optimizer/search/size_to_fit.h"
#include "optimizer/space/ascending.h"
#include "optimizer/words.h"

namespace talus::optimizer {
namespace {

constexpr int kFewest = 5;  // evaluations a model can stand on
// A model of the images is given up only where its error is this many times that of a process of
// the values: under noise both errors are mostly the noise of what was left out, and images know
// more than that shows.
constexpr double kPreference = 1.5;

double Rms(const Eigen::ArrayXd& errors) { return std::sqrt(errors.square().mean()); }

// The error over the better half of the values, where the search is: how far a model misses the
// worst heaps, which differ most, says nothing of it.
double ErrorOf(const Eigen::VectorXd& predicted, const Eigen::VectorXd& values) {
  std::vector<Eigen::Index> order = Ascending(values);
  order.resize((order.size() + 1) / 2);
  return Rms(predicted(order) - values(order));
}

// Left out one by one, how far the model is off: replicates count as one.
double ErrorOf(const ImageModel& model, const CodedImages& data) {
  return ErrorOf(model.LeaveOneOut(),
                 surrogate::Pool({.points = data.Points(), .values = data.values}).values);
}

bool AreAlike(const std::vector<Eigen::VectorXd>& vectors, int count) {
  return std::all_of(vectors.begin(), vectors.begin() + count,
                     [&](const Eigen::VectorXd& vector) { return vector == vectors.front(); });
}

}  // namespace

ImageHistory::ImageHistory(const FieldObjective& objective, std::uint64_t seed)
    : objective_(objective), seed_(seed) {
  const surrogate::FieldSize size{.width = objective.width, .height = objective.height};
  codes_.push_back({std::make_shared<surrogate::EdgeCode>(size, objective.target), {}, {}});
  codes_.push_back({std::make_shared<surrogate::PixelCode>(size, objective.target), {}, {}});
}

void ImageHistory::Add(const Observation& observation) {
  points_.push_back(observation.point);
  values_.push_back(observation.value);
  for (Coded& coded : codes_) {
    coded.vectors.push_back(coded.code->Encode(observation.field));
    const Eigen::VectorXd& vector = coded.vectors.back();
    const double decoded = objective_.metric ? objective_.metric(coded.code->Decode(vector))
                                             : objective_.sad_scale * coded.code->Sad(vector);
    coded.reconstruction_errors.push_back(observation.value - decoded);
  }
}

CodedImages ImageHistory::First(const Coded& coded, int count) const {
  const auto first = [&](const auto& all) { return std::vector(all.begin(), all.begin() + count); };
  return {.outputs = {.points = first(points_),
                      .level = std::vector<int>(static_cast<std::size_t>(count), 0),
                      .vectors = first(coded.vectors),
                      .scalars = std::vector<std::vector<double>>(static_cast<std::size_t>(count))},
          .values = Eigen::Map<const Eigen::VectorXd>(values_.data(), count),
          .reconstruction_errors =
              Eigen::Map<const Eigen::VectorXd>(coded.reconstruction_errors.data(), count)};
}

double ImageHistory::ErrorOfValues(const CodedImages& data, bool deterministic) const {
  const auto process = surrogate::GaussianProcess::Fit(
      {.points = data.Points(), .values = data.values}, {.trend = surrogate::Trend::kQuadratic,
                                                         .warp_inputs = !deterministic,
                                                         .deterministic = deterministic,
                                                         .seed = seed_});
  return ErrorOf(process.LeaveOneOut().mean, process.values());
}

// Column heights are tried first, and what comes after only where they fail.
void ImageHistory::Choose(int count, bool deterministic) {
  choice_ = {.num_fitted = count, .deterministic = deterministic, .state = {}};
  verdict_.clear();
  const CodedImages data = First(codes_.front(), count);
  double lowest = ErrorOfValues(data, deterministic);
  const double sd = Rms(data.values.array() - data.values.mean());
  if (!(sd > 0)) {
    verdict_ = "all values are the same so far";
    return;
  }
  verdict_ = "left out, each of the better half is missed by " + Percent(lowest / sd) +
             " of their standard deviation by a process of the values";
  if (!deterministic) lowest *= kPreference;
  for (const Coded& coded : codes_) {
    if (AreAlike(coded.vectors, count)) continue;  // no mode tells them apart
    const CodedImages fields = First(coded, count);
    const ImageModel model(coded.code, objective_, fields,
                           {.deterministic = deterministic, .seed = seed_}, nullptr);
    const double error = ErrorOf(model, fields);
    verdict_ += ", by " + Percent(error / sd) + " by modes of " + coded.code->name();
    if (!(error < lowest)) continue;
    lowest = error;
    left_out_share_ = error / sd;
    choice_.coded = &coded;
    choice_.state = model.state();
    break;
  }
}

std::optional<ImageModel> ImageHistory::Model(bool deterministic) {
  if (size() < kFewest) return std::nullopt;
  const int count = SizeToFit(size(), kFewest);
  if (choice_.num_fitted != count || choice_.deterministic != deterministic) {
    Choose(count, deterministic);
  }
  if (choice_.coded == nullptr) return std::nullopt;
  return ImageModel(choice_.coded->code, objective_, First(*choice_.coded, size()),
                    {.deterministic = deterministic, .seed = seed_}, &*choice_.state);
}

}  // namespace talus::optimizer
