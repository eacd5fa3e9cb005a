// A chart as SVG, for a paper: axes with ticks, lines, bands, points, cells and a legend.
#pragma once

#include <string>
#include <vector>

#include "experiments/analysis/report/charts/colors.h"

namespace talus::analysis {

struct SvgAxis {
  std::string title;
  double low = 0;
  double high = 1;
  bool log = false;    // low > 0
  bool whole = false;  // its ticks are whole numbers
};

struct SvgPoint {
  double x = 0;
  double y = 0;
};

struct SvgBox {
  SvgPoint from;
  SvgPoint to;
};

struct SvgStyle {
  std::string color = kInk;
  double width = 1.5;   // of a line; diameter of a point [px]
  bool dashed = false;  // a line
  double opacity = 1;
};

class SvgChart {
 public:
  // `equal_scale`: as high as it must be for a unit of y to be as long as one of x.
  SvgChart(SvgAxis x, SvgAxis y, bool equal_scale = false);

  // What has a name is in the legend. Points outside the axes are left out, lines end at them.
  void Line(const std::vector<SvgPoint>& points, const SvgStyle& style,
            const std::string& name = "");
  void Band(const std::vector<SvgPoint>& low, const std::vector<SvgPoint>& high,
            const SvgStyle& style, const std::string& name = "");
  void Points(const std::vector<SvgPoint>& points, const SvgStyle& style,
              const std::string& name = "");
  void Star(const SvgPoint& point, const std::string& name = "");
  void Cell(const SvgBox& box, const std::string& color);

  std::string Text() const;

 private:
  struct Entry {
    std::string name;
    std::string mark;  // SVG around (0, 0)
  };
  double PixelX(double x) const;
  double PixelY(double y) const;
  bool Inside(const SvgPoint& point) const;
  std::string Path(const std::vector<SvgPoint>& points) const;
  std::string AxesText() const;
  std::string LegendText() const;

  SvgAxis x_;
  SvgAxis y_;
  double plot_height_ = 0;  // [px]
  double left_ = 0;         // of the plot, beside the upright axis [px]
  std::string body_;
  std::vector<Entry> legend_;
};

}  // namespace talus::analysis
