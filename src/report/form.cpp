#include "report/form.hpp"

#include "base/error.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace facetmill::report {

ReportForm form_of(const std::string& path) {
    if (path == "-") return ReportForm::json;
    const std::string extension = std::filesystem::path(path).extension().generic_string();
    if (extension == ".json") return ReportForm::json;
    if (extension == ".html") return ReportForm::html;
    if (extension == ".md") return ReportForm::markdown;
    if (extension == ".xml") return ReportForm::junit;
    if (extension == ".txt") return ReportForm::text;
    throw Error(
        ErrorKind::usage, "E-REPORT", fmt::format("a report is {}, found '{}'", report_suffixes, path),
        fmt::format("give it a suffix: {}.html", std::filesystem::path(path).stem().generic_string()));
}

} // namespace facetmill::report
