#include "docs/manual.hpp"

namespace facetmill::docs {

std::string title_of(const ManualPage& page) {
    const std::string_view line = page.text.substr(0, page.text.find('\n'));
    return std::string(line.substr(line.starts_with("# ") ? 2 : 0));
}

} // namespace facetmill::docs
