#include "base/text/short_names.hpp"

#include <filesystem>
#include <vector>

namespace facetmill {

namespace {

/// The components from last to first. "-" becomes a component that no file has.
std::vector<std::string> components_of(const std::string& path) {
    if (path == "-") return {"standard input"};
    std::vector<std::string> out;
    for (const auto& component : std::filesystem::path(path).lexically_normal())
        if (!component.empty()) out.insert(out.begin(), component.generic_string());
    return out.empty() ? std::vector<std::string>{path} : out;
}

/// depth: the depth of the component where the name begins.
std::string name_from(const std::vector<std::string>& components, std::size_t depth) {
    if (depth == 0 || components.size() <= depth) return components.front();
    const std::string first = components[depth] == "/" ? "" : components[depth];
    return first + (depth > 1 ? "/.../" : "/") + components.front();
}

} // namespace

std::string short_name(const std::string& path) { return components_of(path).front(); }

std::pair<std::string, std::string> short_names(const std::string& a, const std::string& b) {
    const auto of_a = components_of(a), of_b = components_of(b);
    std::size_t depth = 0;
    while (depth < of_a.size() && depth < of_b.size() && of_a[depth] == of_b[depth]) ++depth;
    return {name_from(of_a, depth), name_from(of_b, depth)};
}

} // namespace facetmill
