#pragma once
// Compares two scenes: the result of `facetmill diff`.

#include "diff/conversion.hpp"
#include "diff/items.hpp"
#include "diff/pictures.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/inspect/inspect.hpp"
#include "report/record.hpp"

#include <set>

namespace facetmill::report {

/// The sections of a comparison, in the order they are shown.
inline constexpr const char* comparison_sections[] = {"counts",    "topology", "geometry", "attributes",
                                                      "materials", "parts",    "document"};

struct ComparisonSettings {
    std::set<std::string> ignored; ///< sections that are shown but do not decide
    DeviationSettings deviation;
    /// The allowed distance of the surfaces, in units of the first scene, or in percent of its diagonal.
    /// Without any limit the maximum may be a ten-thousandth of a percent: the precision of float32
    /// coordinates.
    struct Limit {
        double amount = 0;
        bool percent = false;
    };
    std::optional<Limit> maximum, rms, mean;
    double attribute_limit = 1e-6; ///< how far attribute values may be apart
    std::optional<Origin> origin;  ///< none: what the scenes have is what their files state
};

/// One line of the comparison.
struct Difference {
    std::string section, name;
    Json a, b;
    bool same = true;
    std::string note;       ///< "at most 0.5 %", "largest difference 0.2 at vertex 7"
    bool compared = true;   ///< false: not comparable, and the note has the reason
    bool of_places = false; ///< for a material: its position differs, not its properties
};

/// Something of a file that was not read, so that nothing is known of it.
struct LeftOut {
    bool of_a = false; ///< of the first file, else of the second
    std::string what;
};

/// The bytes of a file and of the files it refers to, and their use.
struct SizeOnDisk {
    std::uint64_t bytes = 0;
    io::ByteKinds kinds;
};

struct Comparison {
    std::vector<Difference> lines;            ///< equal ones too
    std::optional<DeviationResult> deviation; ///< none when geometry is ignored
    const char *geometry_a = "nothing",
               *geometry_b = "nothing"; ///< the kind of geometry: surface, points, nothing
    std::vector<LeftOut> left_out;
    std::set<std::string> ignored;
    Properties properties_a, properties_b;
    std::vector<ItemChange> items; ///< parts and materials by their names
    std::optional<SizeOnDisk> size_a = {}, size_b = {};
    std::string hint; ///< a unit or an up axis that would explain how the geometry differs

    /// Whether a line that decides differs.
    bool differs() const;
    /// Whether nothing was left out, and no line that decides could not be compared.
    bool complete() const;
};

/// The properties of property_table() one by one; the deviation both ways, of the surfaces, or of the points
/// where a scene has no faces; attributes by name, domain and type, and by value where both have as many
/// elements; materials by name, look and the faces they are on; parts by name; of glTF documents what is
/// beside meshes. In world space, both scenes in the same convention.
Comparison compare(const Scene& a, const Scene& b, const ComparisonSettings& settings = {});

/// {a, b, same, complete, left_out, sections: {counts: {same, decides, lines: [{name, a, b, same, compared,
/// note}]}, ...}, geometry_of: {a, b}, deviation}.
Json to_json(const Comparison& comparison, const std::string& name_a, const std::string& name_b);
/// A table; lines that are equal only with `all`.
std::string to_text(const Comparison& comparison, const std::string& name_a, const std::string& name_b,
                    bool all);
/// One self-contained page: the verdict, both scenes by one camera with a slider, both files beside each
/// other, parts and materials that came, went or changed, distances as colours, and the lines that differ.
/// Files are called by the shortest names that tell them apart.
std::string to_html(const Comparison& comparison, const std::string& path_a, const std::string& path_b,
                    const ComparisonPictures& pictures);
/// "agree", "differ", "agree in everything that was compared".
std::string verdict_of(const Comparison& comparison);
/// "counts, geometry": the sections with a line that decides and differs.
std::string differs_in(const Comparison& comparison);
/// Tables for the description of a change, with names as to_html has them.
std::string to_markdown(const Comparison& comparison, const std::string& path_a, const std::string& path_b);
Json comparison_schema();

} // namespace facetmill::report
