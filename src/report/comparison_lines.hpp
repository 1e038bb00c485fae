#pragma once
// The sections of a comparison, each in a file of its own.

#include "report/comparison.hpp"

namespace facetmill::report {

/// What a section is compared with, and where its lines go.
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
};

/// Which way the surfaces look, and how far they are apart.
void compare_geometry(const Comparing& with);
/// Attributes by name, domain and type, and by value.
void compare_attributes(const Comparing& with);

} // namespace facetmill::report
