#include "base/mark.hpp"

#include <fmt/format.h>

namespace facetmill {

Mark file_mark(std::string name) {
    return {std::make_shared<const SourceText>(SourceText{std::move(name), {}}), 0, 0, 1};
}

Mark line_mark(std::string name, int line) {
    return {std::make_shared<const SourceText>(SourceText{std::move(name), {}}), line, 0, 1};
}

std::string to_string(const Mark& mark) {
    if (!mark.known()) return {};
    if (mark.line == 0) return mark.source->name;
    if (mark.column == 0) return fmt::format("{}:{}", mark.source->name, mark.line);
    return fmt::format("{}:{}:{}", mark.source->name, mark.line, mark.column);
}

} // namespace facetmill
