// The reference optima that regrets are measured from.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "bench/optimizers/problems.h"
#include "bench/optimizers/random_numbers.h"

namespace talus::bench {
namespace {

// Numerical optimum (only for the problems without a known one): random search, then Nelder-Mead
// restarts.
void NumericalOptimum(const Problem& p, Vec& best, double& fbest) {
  Rng rng(HashString("optimum"));
  std::vector<std::pair<double, Vec>> pool;
  for (int i = 0; i < 3000; ++i) {
    Vec u{rng.Uniform(), rng.Uniform(), rng.Uniform()};
    pool.push_back({p.Value(u), u});
  }
  std::sort(pool.begin(), pool.end(), [](auto& a, auto& b) { return a.first < b.first; });
  fbest = 1e300;
  for (int s = 0; s < 8; ++s) {
    Vec x0 = pool[s * 3].second;
    for (int round = 0; round < 4; ++round) {
      double step = 0.12 * std::pow(0.3, round);
      std::vector<std::pair<double, Vec>> S;
      S.push_back({p.Value(x0), x0});
      for (int k = 0; k < D; ++k) {
        Vec y = x0;
        y[k] = Clamp01(y[k] + (y[k] > 0.5 ? -step : step));
        S.push_back({p.Value(y), y});
      }
      for (int it = 0; it < 150; ++it) {
        std::sort(S.begin(), S.end(), [](auto& a, auto& b) { return a.first < b.first; });
        if (S[D].first - S[0].first < 1e-12) break;
        Vec c{};
        for (int i = 0; i < D; ++i)
          for (int k = 0; k < D; ++k) c[k] += S[i].second[k] / D;
        auto at = [&](double t) {
          Vec y;
          for (int k = 0; k < D; ++k) y[k] = Clamp01(c[k] + t * (S[D].second[k] - c[k]));
          return y;
        };
        Vec r = at(-1);
        double fr = p.Value(r);
        if (fr < S[0].first) {
          Vec e = at(-2);
          double fe = p.Value(e);
          S[D] = fe < fr ? std::make_pair(fe, e) : std::make_pair(fr, r);
        } else if (fr < S[D - 1].first)
          S[D] = {fr, r};
        else {
          Vec k2 = at(fr < S[D].first ? -0.5 : 0.5);
          double fk = p.Value(k2);
          if (fk < std::min(fr, S[D].first))
            S[D] = {fk, k2};
          else
            for (int i = 1; i <= D; ++i) {
              for (int k = 0; k < D; ++k) S[i].second[k] = 0.5 * (S[i].second[k] + S[0].second[k]);
              S[i].first = p.Value(S[i].second);
            }
        }
      }
      std::sort(S.begin(), S.end(), [](auto& a, auto& b) { return a.first < b.first; });
      x0 = S[0].second;
      if (S[0].first < fbest) {
        fbest = S[0].first;
        best = x0;
      }
    }
  }
}

}  // namespace

void Optimum(const Problem& p, Vec& x, double& f) {
  if (!p.KnownOptimum(x, f)) NumericalOptimum(p, x, f);
}

}  // namespace talus::bench
