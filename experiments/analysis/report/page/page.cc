#include "experiments/analysis/report/page/page.h"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "base/replaced.h"
#include "base/text/markup.h"
#include "experiments/analysis/report/charts/colors.h"
#include "page_files.h"  // made by talus_embed

namespace talus::analysis {
namespace {

// What stands in the template for {{name}}.
struct PagePart {
  std::string_view name;
  std::string_view text;
};

// In one pass: what is put in, such as a campaign's name, is never searched for a placeholder.
std::string Filled(std::string_view page, std::span<const PagePart> parts) {
  std::string filled;
  for (auto at = page.find("{{"); at != std::string_view::npos; at = page.find("{{")) {
    const auto end = page.find("}}", at);
    const std::string_view name = page.substr(at + 2, end - at - 2);
    filled += page.substr(0, at);
    filled += std::ranges::find(parts, name, &PagePart::name)->text;
    page.remove_prefix(end + 2);
  }
  return filled += page;
}

std::string Scripts() {
  return std::string(page_files::kFormatJs) + std::string(page_files::kChartsJs) +
         std::string(page_files::kSearchChartsJs) + std::string(page_files::kSpaceChartsJs) +
         std::string(page_files::kProfileChartsJs) + std::string(page_files::kOverlayJs) +
         std::string(page_files::kTrialTableJs) + std::string(page_files::kPredictionsJs) +
         std::string(page_files::kAnswerJs) + std::string(page_files::kRunningJs) +
         std::string(page_files::kSectionsJs) + std::string(page_files::kPageJs);
}

// The charting library asks that its licences go with every copy.
std::string Licences() {
  std::string all;
  for (const std::string_view text :
       {page_files::kNOTICEEcharts, page_files::kLICENSEEchartsD3, page_files::kLICENSEEchartsGl,
        page_files::kLICENSEEchartsGlSubcomponents}) {
    all.append(text).append("\n\n");
  }
  return all;
}

// As long as the campaign runs.
std::string Reloading(const ReportData& data, const PageOptions& options) {
  if (options.reload <= 0 || !data.evidence.IsRunning()) return "";
  return "<meta http-equiv=\"refresh\" content=\"" + std::to_string(options.reload) + "\">";
}

}  // namespace

std::string ReportPage(const ReportData& data, const PageOptions& options) {
  const std::string title = base::MarkupText(data.evidence.name) + " – calibration report";
  const std::string reload = Reloading(data, options);
  const std::string css = ColorProperties() + std::string(page_files::kPageCss);
  const std::string scripts = Scripts();
  const std::string licences = Licences();
  // JSON inside a script element: a `<` could end it.
  const std::string json = base::Replaced(PageJson(data), "<", "\\u003c");
  const std::array<PagePart, 8> parts{{{"title", title},
                                       {"reload", reload},
                                       {"css", css},
                                       {"data", json},
                                       {"licences", licences},
                                       {"echarts", page_files::kEchartsMinJs},
                                       {"echarts_gl", page_files::kEchartsGlMinJs},
                                       {"js", scripts}}};
  return Filled(page_files::kPageHtml, parts);
}

}  // namespace talus::analysis
