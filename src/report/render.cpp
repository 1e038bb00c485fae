#include "report/render.hpp"

#include "report/form.hpp"

namespace facetmill::report {

std::string render_for(const std::string& path, const RunRecord& record, const Json& view) {
    switch (form_of(path)) {
    case ReportForm::json:
        return to_json(record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    case ReportForm::html:
        return to_html(record, view);
    case ReportForm::markdown:
        return to_markdown(record);
    case ReportForm::junit:
        return to_junit(record);
    case ReportForm::text:
        break;
    }
    return to_text(record);
}

} // namespace facetmill::report
