#include "base/progress.hpp"
#include "diff/conversion.hpp"
#include "diff/lines.hpp"
#include "report/render.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::report {

namespace {

void compare_properties(const Comparing& with) {
    ProgressSteps steps({1, 1});
    const Properties a = inspect(with.a);
    steps.next();
    const Properties b = inspect(with.b);
    steps.next();
    with.result.properties_a = a;
    with.result.properties_b = b;
    for (const auto& p : property_table()) {
        const bool counted = p.kind == PropertyKind::count || p.truth();
        if (!counted || p.costly || p.of_scene() || p.on_request()) continue;
        if (p.where_any && p.get(a) == 0 && p.get(b) == 0) continue;
        with.add(p.is_size ? "counts" : "topology", std::string(p.name), property_json(p, a),
                 property_json(p, b));
    }
}

} // namespace

bool Comparison::differs() const {
    return std::any_of(lines.begin(), lines.end(),
                       [&](const Difference& d) { return !d.same && !ignored.contains(d.section); });
}

bool Comparison::complete() const {
    return left_out.empty() && std::all_of(lines.begin(), lines.end(), [&](const Difference& d) {
               return d.compared || ignored.contains(d.section);
           });
}

std::string differs_in(const Comparison& comparison) {
    std::string sections;
    for (const char* section : comparison_sections)
        if (!comparison.ignored.contains(section) &&
            std::any_of(comparison.lines.begin(), comparison.lines.end(),
                        [&](const Difference& d) { return d.section == section && !d.same; }))
            append_item(sections, section);
    return sections;
}

Comparison compare(const Scene& a, const Scene& b, const ComparisonSettings& settings) {
    Comparison result;
    const Comparing with{a, b, settings, result};
    ProgressSteps steps({2, settings.ignored.contains("geometry") ? 0.0 : 12.0, 2});
    compare_properties(with);
    steps.next();
    if (!settings.ignored.contains("geometry")) compare_geometry(with);
    steps.next();
    compare_attributes(with);
    compare_materials(with);
    compare_names(with, "parts", a.parts, b.parts);
    compare_documents(with);
    const auto limit = maximum_of(settings);
    const double most = !limit           ? 0
                        : limit->percent ? limit->amount / 100 * a.bounds().diagonal()
                                         : limit->amount;
    result.items = item_changes(a, b, most);
    result.ignored = settings.ignored;
    const auto differs = [](const Difference& line) { return line.section == "geometry" && !line.same; };
    if (std::any_of(result.lines.begin(), result.lines.end(), differs))
        result.hint =
            conversion_hint(a, b, settings.origin.value_or(Origin{{a.unit, a.up}, {b.unit, b.up}, {}}));
    return result;
}

} // namespace facetmill::report
