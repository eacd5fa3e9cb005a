#include "surrogate/process/replicates.h"

namespace talus::surrogate {

Eigen::Index AddTo(PooledData& data, const Eigen::VectorXd& point, double value) {
  ++data.num_values;
  const Eigen::Index size = data.values.size();
  for (Eigen::Index i = 0; i < size; ++i) {
    if ((data.points.col(i) - point).lpNorm<Eigen::Infinity>() > kSamePoint) continue;
    const double count = data.counts[i] + 1;
    const double difference = value - data.values[i];
    data.values[i] += difference / count;
    data.sum_of_squares += difference * (value - data.values[i]);  // Welford's update
    data.counts[i] = count;
    return i;
  }
  data.points.conservativeResize(point.size(), size + 1);
  data.points.col(size) = point;
  data.values.conservativeResize(size + 1);
  data.values[size] = value;
  data.counts.conservativeResize(size + 1);
  data.counts[size] = 1;
  return size;
}

PooledData Pool(const Eigen::MatrixXd& points, const Eigen::VectorXd& values) {
  PooledData data;
  for (Eigen::Index i = 0; i < points.rows(); ++i) AddTo(data, points.row(i), values[i]);
  return data;
}

}  // namespace talus::surrogate
