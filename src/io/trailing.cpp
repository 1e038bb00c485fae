#include "io/trailing.hpp"

#include <fmt/format.h>

namespace facetmill::io {

void warn_of_trailing(ReadLog& log, const std::string& file, std::size_t bytes, const std::string& after) {
    if (bytes == 0) return;
    log.warnings.push_back({Severity::warning, "W-TRAILING",
                            fmt::format("{} bytes after {} are skipped", bytes, after), file_mark(file), ""});
}

} // namespace facetmill::io
