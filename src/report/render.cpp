#include "report/render.hpp"

#include <filesystem>
#include <fmt/format.h>

namespace facetmill::report {

std::string render_for(const std::string& path, const RunRecord& record) {
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension == ".json")
        return to_json(record).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    if (extension == ".html") return to_html(record);
    if (extension == ".xml") return to_junit(record);
    if (extension == ".txt") return to_text(record);
    throw Error(ErrorKind::usage, "E-REPORT",
                fmt::format("a report is .json, .html, .xml (JUnit) or .txt, found '{}'", path));
}

} // namespace facetmill::report
