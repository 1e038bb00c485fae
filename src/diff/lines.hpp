#pragma once
// The sections of a comparison, each in a separate file.

#include "diff/comparison.hpp"

namespace facetmill::report {

/// The input of a section, and the destination of its lines.
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
    /// Adds a line that could not be compared, and the reason.
    void leave(const char* section, std::string name, Json x, Json y, const std::string& why) const {
        result.lines.push_back(
            {section, std::move(name), std::move(x), std::move(y), true, "not compared: " + why, false});
    }
};

/// The lines of a section, in order.
inline std::vector<const Difference*> of_section(const Comparison& comparison, const std::string& section) {
    std::vector<const Difference*> lines;
    for (const auto& d : comparison.lines)
        if (d.section == section) lines.push_back(&d);
    return lines;
}

using Limit = ComparisonSettings::Limit;

/// Null for numbers that JSON cannot represent.
inline Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

/// The maximum distance between the surfaces: as given, or float32 precision without any limit.
std::optional<Limit> maximum_of(const ComparisonSettings& settings);

/// Compares the counts, and the names in order.
template <class List>
void compare_names(const Comparing& with, const char* section, const List& a, const List& b) {
    with.add(section, "number", a.size(), b.size());
    for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
        with.add(section, std::to_string(i), i < a.size() ? Json(a[i].name) : Json(nullptr),
                 i < b.size() ? Json(b[i].name) : Json(nullptr));
}

/// Compares the orientation and the distance of the surfaces.
void compare_geometry(const Comparing& with);
/// Compares attributes by name, domain, type and value.
void compare_attributes(const Comparing& with);
/// Compares materials by index: name, look, and the location of their faces.
void compare_materials(const Comparing& with);
/// Compares the contents of glTF documents besides meshes.
void compare_documents(const Comparing& with);

} // namespace facetmill::report
