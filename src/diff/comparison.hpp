#pragma once
// Compares two scenes, for `facetmill diff`.

#include "diff/conversion.hpp"
#include "diff/items.hpp"
#include "diff/pictures.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/record.hpp"

#include <set>

namespace facetmill::report {

/// The sections of a comparison, in display order.
inline constexpr const char* comparison_sections[] = {"counts",    "topology", "geometry", "attributes",
                                                      "materials", "parts",    "document"};

struct ComparisonSettings {
    std::set<std::string> ignored; ///< sections that are shown but do not affect the verdict
    DeviationSettings deviation;
    /// The allowed distance between the surfaces, in units of the first scene, or in percent of its diagonal.
    /// Without limits, the maximum is a ten-thousandth of a percent: the rounding error of float32
    /// coordinates.
    struct Limit {
        double amount = 0;
        bool percent = false;
    };
    std::optional<Limit> maximum, rms, mean;
    double attribute_limit = 1e-6; ///< largest allowed difference of attribute values
    std::optional<Origin> origin;  ///< empty: the scenes are in the conventions of their files
};

/// A line of the comparison.
struct Difference {
    std::string section, name;
    Json a, b;
    bool same = true;
    std::string note;       ///< "at most 0.5 %", "largest difference 0.2 at vertex 7"
    bool compared = true;   ///< false: comparing was impossible, for the reason in note
    bool of_places = false; ///< for a material: its position instead of its appearance
};

/// A part of a file that was not read, and therefore not compared.
struct LeftOut {
    bool of_a = false; ///< true: in the first file; false: in the second
    std::string what;
};

/// The bytes of a file and the files that it refers to, by kind.
struct SizeOnDisk {
    std::uint64_t bytes = 0;
    io::ByteKinds kinds;
};

struct Comparison {
    std::vector<Difference> lines;                               ///< including equal ones
    std::optional<DeviationResult> deviation;                    ///< none if geometry is ignored
    const char *geometry_a = "nothing", *geometry_b = "nothing"; ///< surface, points or nothing
    std::vector<LeftOut> left_out;
    std::set<std::string> ignored;
    Properties properties_a, properties_b;
    std::vector<ItemChange> items; ///< parts and materials by name
    std::optional<SizeOnDisk> size_a = {}, size_b = {};
    std::string hint; ///< a unit or an up axis that would explain the difference

    /// True if a relevant line differs.
    bool differs() const;
    /// True if everything was read, and every relevant line could be compared.
    bool complete() const;
};

/// Compares the properties of property_table() one by one. The deviation is measured in both directions,
/// between the surfaces, or between the points if a scene has no faces. Attributes are compared by name,
/// domain and type, and by value if both have the same number of elements. Materials are compared by name,
/// appearance and faces, parts by name. For glTF documents, contents other than meshes are compared too. In
/// world space; both scenes must use the same convention.
[[nodiscard]] Comparison compare(const Scene& a, const Scene& b, const ComparisonSettings& settings = {});

/// {a, b, same, complete, left_out, sections: {counts: {same, decides, lines: [{name, a, b, same, compared,
/// note}]}, ...}, geometry_of: {a, b}, deviation}.
[[nodiscard]] Json to_json(const Comparison& comparison, const std::string& name_a,
                           const std::string& name_b);
/// A table; equal lines only with `all`.
[[nodiscard]] std::string to_text(const Comparison& comparison, const std::string& name_a,
                                  const std::string& name_b, bool all);
/// A self-contained page with the verdict, and both scenes by the same camera with a slider. It shows both
/// files side by side, added, removed and changed parts and materials, distances as colours, and the
/// different lines. Files have the shortest names that distinguish them.
[[nodiscard]] std::string to_html(const Comparison& comparison, const std::string& path_a,
                                  const std::string& path_b, const ComparisonPictures& pictures);
/// "agree", "differ", "agree in everything that was compared".
[[nodiscard]] std::string verdict_of(const Comparison& comparison);
/// "counts, geometry": the sections with a relevant difference.
[[nodiscard]] std::string differs_in(const Comparison& comparison);
/// Tables for the description of a change, with the same names as to_html.
[[nodiscard]] std::string to_markdown(const Comparison& comparison, const std::string& path_a,
                                      const std::string& path_b);
[[nodiscard]] Json comparison_schema();

} // namespace facetmill::report
