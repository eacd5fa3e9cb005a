#include "experiments/analysis/report/page/page.h"

#include <string_view>

#include "base/replaced.h"
#include "base/text/markup.h"
#include "experiments/analysis/report/charts/colors.h"
#include "page_files.h"  // made by talus_embed

namespace talus::analysis {
namespace {

void Replace(std::string& text, std::string_view what, std::string_view with) {
  text.replace(text.find(what), what.size(), with);
}

}  // namespace

std::string ReportPage(const ReportData& data, const PageOptions& options) {
  std::string page(page_files::kPageHtml);
  const std::string scripts =
      std::string(page_files::kFormatJs) + std::string(page_files::kChartsJs) +
      std::string(page_files::kSearchChartsJs) + std::string(page_files::kSpaceChartsJs) +
      std::string(page_files::kProfileChartsJs) + std::string(page_files::kOverlayJs) +
      std::string(page_files::kTrialTableJs) + std::string(page_files::kPredictionsJs) +
      std::string(page_files::kAnswerJs) + std::string(page_files::kRunningJs) +
      std::string(page_files::kSectionsJs) + std::string(page_files::kPageJs);
  // The data come last: what they hold is never searched for a placeholder.
  Replace(page, "{{title}}", base::MarkupText(data.evidence.name) + " – calibration report");
  const bool reloads = options.reload > 0 && data.evidence.state == "running";
  Replace(page, "{{reload}}",
          reloads
              ? "<meta http-equiv=\"refresh\" content=\"" + std::to_string(options.reload) + "\">"
              : "");
  Replace(page, "{{css}}", ColorProperties() + std::string(page_files::kPageCss));
  Replace(page, "{{js}}", scripts);
  Replace(page, "{{echarts}}", page_files::kEchartsMinJs);
  Replace(page, "{{echarts_gl}}", page_files::kEchartsGlMinJs);
  // JSON inside a script element: a `<` could end it.
  Replace(page, "{{data}}", base::Replaced(PageJson(data), "<", "\\u003c"));
  return page;
}

}  // namespace talus::analysis
