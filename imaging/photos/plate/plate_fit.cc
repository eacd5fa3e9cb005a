#include "imaging/photos/plate/plate_fit.h"

#include <ceres/ceres.h>

#include <array>
#include <cmath>
#include <map>

#include "base/error.h"

namespace talus::imaging {
namespace {

// Pose: centre x, baseline y [px], tilt [rad]. Plate: width, thickness [px].
constexpr int kPose = 3;
constexpr int kPlate = 2;
constexpr double kOutlier = 0.3;        // [px], of an edge point
constexpr double kCornerOutlier = 0.5;  // [px]
constexpr double kCornerWeight = 3;     // one corner stands for several edge points
constexpr double kVagueWeight = 0.1;    // a corner known to about a pixel
constexpr double kRunWeight = 1.0;      // that holds the baselines of a run together
constexpr double kCameraMoves = 0.3;    // [px] between views of a run: more is not held back

// Coordinates of a point as the plate lies, from the middle of its top: along it and downwards.
template <class T>
std::array<T, 2> OnPlate(const T* pose, const EdgePoint& point) {
  const T x = point.x - pose[0];
  const T y = point.y - pose[1];
  const T cosine = ceres::cos(pose[2]);
  const T sine = ceres::sin(pose[2]);
  return {x * cosine + y * sine, y * cosine - x * sine};
}

struct OnSide {
  EdgePoint point;
  double side = 1;  // -1 left, +1 right
  template <class T>
  bool operator()(const T* pose, const T* plate, T* residual) const {
    residual[0] = OnPlate(pose, point)[0] - side * plate[0] / 2.0;
    return true;
  }
};

struct OnLowerEdge {
  EdgePoint point;
  template <class T>
  bool operator()(const T* pose, const T* plate, T* residual) const {
    residual[0] = OnPlate(pose, point)[1] - plate[1];
    return true;
  }
};

struct OnTop {
  EdgePoint point;
  double weight = 1;
  template <class T>
  bool operator()(const T* pose, T* residual) const {
    residual[0] = weight * OnPlate(pose, point)[1];
    return true;
  }
};

struct LikeRun {
  template <class T>
  bool operator()(const T* pose, const T* run, T* residual) const {
    residual[0] = kRunWeight * (pose[1] - run[0]);
    return true;
  }
};

class Fit {
 public:
  explicit Fit(std::span<const PhotographedPlate> plates) : plates_(plates) {
    for (const PhotographedPlate& plate : plates) {
      Start(plate.edges);
      sharp_ |= plate.edges.top_left.sharp || plate.edges.top_right.sharp || plate.edges.seam;
    }
    for (std::size_t i = 0; i < plates.size(); ++i) AddPhoto(i);
  }

  PlateFit Solve() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    options.max_num_iterations = 100;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;  // the sums keep their order
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    if (!summary.IsSolutionUsable()) {
      throw base::Error("the plate cannot be fitted: " + summary.message);
    }
    PlateFit fit{.width = plate_[0], .sharp_corners = sharp_, .poses = {}};
    for (std::size_t i = 0; i < plates_.size(); ++i) {
      fit.poses.push_back({.width = plates_[i].edges.width,
                           .center_x = poses_[i][0],
                           .baseline = poses_[i][1],
                           .tilt = poses_[i][2]});
    }
    return fit;
  }

 private:
  void Start(const PlateEdges& edges) {
    const EdgePoint& left = edges.top_left.point;
    const EdgePoint& right = edges.top_right.point;
    poses_.push_back({(left.x + right.x) / 2, (left.y + right.y) / 2, edges.tilt});
    plate_[0] += edges.width / static_cast<double>(plates_.size());
    if (!edges.lower.empty() && plate_[1] == 0) {
      plate_[1] = OnPlate(poses_.back().data(), edges.lower[edges.lower.size() / 2])[1];
    }
  }

  void AddPhoto(std::size_t i) {
    const PlateEdges& edges = plates_[i].edges;
    double* const pose = poses_[i].data();
    for (const EdgePoint& point : edges.left) AddEdge<OnSide>({point, -1}, pose);
    for (const EdgePoint& point : edges.right) AddEdge<OnSide>({point, +1}, pose);
    for (const EdgePoint& point : edges.lower) AddEdge<OnLowerEdge>({point}, pose);
    AddCorner(edges.top_left, pose);
    AddCorner(edges.top_right, pose);
    if (edges.seam) AddCorner({.point = *edges.seam, .sharp = true}, pose);
    if (!edges.lower.empty()) return;
    double* const run = runs_.try_emplace(plates_[i].run, std::array{pose[1]}).first->second.data();
    problem_.AddResidualBlock(new ceres::AutoDiffCostFunction<LikeRun, 1, kPose, 1>(new LikeRun),
                              new ceres::CauchyLoss(kCameraMoves), pose, run);
  }

  template <class Residual>
  void AddEdge(const Residual& residual, double* pose) {
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Residual, 1, kPose, kPlate>(new Residual(residual)),
        new ceres::CauchyLoss(kOutlier), pose, plate_.data());
  }

  // Where some photograph shows a sharp corner, the others' guesses count little.
  void AddCorner(const PlateCorner& corner, double* pose) {
    const double weight = corner.sharp ? kCornerWeight : kVagueWeight;
    problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<OnTop, 1, kPose>(new OnTop{corner.point, weight}),
        new ceres::CauchyLoss(kCornerOutlier * weight), pose);
  }

  std::span<const PhotographedPlate> plates_;
  bool sharp_ = false;
  std::array<double, kPlate> plate_{};
  std::vector<std::array<double, kPose>> poses_;
  std::map<std::size_t, std::array<double, 1>> runs_;
  ceres::Problem problem_;
};

}  // namespace

PlateFit FitPlates(std::span<const PhotographedPlate> plates) { return Fit(plates).Solve(); }

}  // namespace talus::imaging
