// The height of the plate's top, from the brightness around one of the plate's upper corners.
//
//   dark:       x > 0 and y < h(x)
//   h(x) = b + m tan θ + c m (m - X)/2,   m = max(x, s)
//   brightness: light - (light - dark) C(x, y)
//   C(x, y) = ∫₀^∞ φ((x - x′)/σ)/σ Φ((h(x′) - y)/σ) dx′
//
// x inwards from the plate's side to X, y up [px]; φ, Φ the normal density and distribution. On a
// shelf of the plate's top, s long and h(s) high, begins the heap's slope θ, which may bend by c; C
// is the dark area under a Gaussian blur σ. With s = 0 the slope begins at the rim.
//
// The outline alone tells no shelf shorter than some σ: it runs round from the side into the slope
// with one and without. The triangle s²/2 tan θ that lacks below the slope is seen by all pixels
// around it. The fit is in s², in which the brightness is linear where s is small. A slope that
// bends inwards looks much the same: only a shelf that explains more than a usual bend is believed.
#pragma once

#include <optional>
#include <vector>

namespace talus::imaging {

struct SeenPixel {
  double in = 0;     // x of its centre [px]
  double up = 0;     // y [px]
  double level = 0;  // brightness [-]
};

struct CornerGuess {
  double slope_at_side = 0;  // b [px]
  double shelf = 0;          // s [px]
  double slope = 0;          // tan θ [-]
  double blur = 1;           // σ [px], known to some percent
  double dark = 0;           // brightness of the plate [-]; the background's is about 1
  double bend = 0.003;       // c, its usual size [1/px]
  double farthest = 14;      // X, of the outline's last point [px]
};

// [px]; nothing where the brightness is not that of such a corner: powder hangs over the rim, or
// grains or a steep foot stand next to it.
std::optional<double> FitTop(const std::vector<SeenPixel>& pixels, const CornerGuess& guess);

}  // namespace talus::imaging
