#pragma once
// The sections of a comparison, one file each.

#include "diff/comparison.hpp"

namespace facetmill::report {

/// The input of a section, and the output for its lines.
struct Comparing {
    const Scene &a, &b;
    const ComparisonSettings& settings;
    Comparison& result;

    void add(const char* section, std::string name, Json x, Json y, bool same, std::string note = {}) const {
        result.lines.push_back({section, std::move(name), std::move(x), std::move(y), same, std::move(note)});
    }
    void add(const char* section, std::string name, const Json& x, const Json& y) const {
        add(section, std::move(name), x, y, x == y);
    }
    /// Adds a line that was not compared, with the reason.
    void leave(const char* section, std::string name, Json x, Json y, const std::string& why) const {
        result.lines.push_back(
            {section, std::move(name), std::move(x), std::move(y), true, "not compared: " + why, false});
    }
};

/// The lines of a section, in order.
[[nodiscard]] inline std::vector<const Difference*> of_section(const Comparison& comparison,
                                                               const std::string& section) {
    std::vector<const Difference*> lines;
    for (const auto& d : comparison.lines)
        if (d.section == section) lines.push_back(&d);
    return lines;
}

using Limit = ComparisonSettings::Limit;

/// Null for numbers that JSON does not have.
[[nodiscard]] inline Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// The maximum distance of the surfaces: as given, or, without any limit, the rounding error of float32.
[[nodiscard]] std::optional<Limit> maximum_of(const ComparisonSettings& settings);

/// The number of items, and their names in order.
template <class List>
void compare_names(const Comparing& with, const char* section, const List& a, const List& b) {
    with.add(section, "number", a.size(), b.size());
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
        with.add(section, std::to_string(i), i < a.size() ? Json(a[i].name) : Json(nullptr),
                 i < b.size() ? Json(b[i].name) : Json(nullptr));
}

/// The orientation of the surfaces, and their distance.
void compare_geometry(const Comparing& with);
/// Attributes by name, domain and type, and by value.
void compare_attributes(const Comparing& with);
/// Materials by number: name, appearance, and the positions of their faces.
void compare_materials(const Comparing& with);
/// The contents of a glTF other than meshes.
void compare_documents(const Comparing& with);

} // namespace facetmill::report
