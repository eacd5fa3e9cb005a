#include "surrogate/process/replicates.h"

#include "surrogate/same_point.h"

namespace talus::surrogate {
namespace {

void Append(PooledData& data, const Site& site, double value, int first) {
  const Eigen::Index size = data.size();
  data.sites.columns.conservativeResize(site.x.size(), size + 1);
  data.sites.columns.col(size) = site.x;
  data.sites.growth.conservativeResize(size + 1);
  data.sites.growth[size] = site.growth;
  data.level.conservativeResize(size + 1);
  data.level[size] = site.level;
  data.values.conservativeResize(size + 1);
  data.values[size] = value;
  data.counts.conservativeResize(size + 1);
  data.counts[size] = 1;
  data.first.conservativeResize(size + 1);
  data.first[size] = first;
}

}  // namespace

Eigen::Index AddTo(PooledData& data, const Site& site, double value) {
  const Eigen::Index size = data.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    if (data.level[i] != site.level || !SamePoint(data.sites.columns.col(i), site.x)) continue;
    const double count = data.counts[i] + 1;
    const double difference = value - data.values[i];
    data.values[i] += difference / count;
    // Welford's update
    data.sum_of_squares[site.level] += difference * (value - data.values[i]);
    data.num_extra[site.level] += 1;
    data.counts[i] = count;
    return i;
  }
  const int first = static_cast<int>(size > 0 ? data.num_values() : 0);
  Append(data, site, value, first);
  return size;
}

PooledData Pool(const Evaluations& evaluations, int num_levels) {
  PooledData data;
  data.sum_of_squares = Eigen::VectorXd::Zero(num_levels);
  data.num_extra = Eigen::VectorXd::Zero(num_levels);
  for (Eigen::Index i = 0; i < evaluations.points.rows(); ++i) {
    Site site{.x = evaluations.points.row(i)};
    if (evaluations.growth.size() > 0) site.growth = evaluations.growth[i];
    if (evaluations.level.size() > 0) site.level = evaluations.level[i];
    AddTo(data, site, evaluations.values[i]);
  }
  return data;
}

}  // namespace talus::surrogate
