#include "stages/measure/options.hpp"

#include "base/refusal.hpp"
#include "base/text/spelling.hpp"
#include "base/text/words.hpp"
#include "geometry/model_row/model_row.hpp"
#include "options/mark_at.hpp"
#include "stage/options/synonyms.hpp"
#include "stages/measure/face_table.hpp"
#include "stages/measure/robot_text.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace facetmill::measure_stage {

namespace {

/// "The largest angle of a face. Stored at faces. No value where ..."
std::string told(const Quantity& q) {
    std::string text =
        fmt::format("{} Stored at {}.", q.help, q.domain == Domain::face ? "faces" : "vertices");
    if (!q.missing.empty()) text += fmt::format(" No value {}.", q.missing);
    return text;
}

std::string model_column_names() {
    std::string names;
    for (const ModelColumn& column : model_columns()) append_item(names, column.name);
    return names;
}

bool compares(const MeasureOptions& o) {
    return std::any_of(o.attributes.begin(), o.attributes.end(),
                       [](const QuantityName& name) { return name.quantity && name.quantity->compares; });
}

} // namespace

void declare_measure(Declare<MeasureOptions>& d) {
    d.option("density", &MeasureOptions::density,
             "The mass per cubic scene unit. It scales mass and inertia.")
        .above(0);
    d.option("feature_angle", &MeasureOptions::feature_angle,
             "Edges whose two face normals differ by more than this angle count as feature edges.")
        .between(0, 180);
    Option& attributes =
        d.option(
             "attributes", &MeasureOptions::attributes,
             "Stores these quantities as attributes of faces or vertices, in world space and scene units.")
            .also_called("areas", "attributes: area")
            .also_called("curvature curvatures", "attributes: [mean_curvature, gaussian_curvature]")
            .option();
    for (const Quantity& q : quantities()) attributes.choices.push_back({std::string(q.name), told(q)});
    d.option("with", &MeasureOptions::with,
             "The reference mesh file for deviation. Default: the scene as loaded.")
        .also_called(with_synonyms);
    d.option("missing", &MeasureOptions::missing,
             "The value of an attribute where no number exists. Default: nan, which render shows as \"no "
             "value\" and PLY stores. Other formats store 0 instead of nan (W-NAN).");
    d.choice("per", &MeasureOptions::per,
             {{"face", Per::face, "a row for each face"},
              {"part", Per::part, "a row for each part, with its size, smallest wall and overhangs"},
              {"scene", Per::scene, "a single row for the scene, with the same columns"}},
             "The rows of the tables in path.");
    d.option("overhang_angle", &MeasureOptions::overhang_angle,
             "The slope below which a face that looks down counts as an overhang, for per: part and per: "
             "scene.")
        .between(0, 90);
    d.option("path", &MeasureOptions::path,
             "The file to write, or a list of files. The suffix selects the format: .json for all results, "
             ".csv for a table, .jsonl for a table of parts or of the scene. .urdf and .mjcf store the mass, "
             "centre of mass and inertia of each part, with lengths in metres. - writes JSON to standard "
             "output. Columns of a table of parts: part, " +
                 model_column_names() + ", unit. Columns of a table of faces: " + face_table_help() + ".")
        .also_called(path_synonyms);
}

void verify_measure(const MeasureOptions& o, const Value& given, Problems& problems) {
    for (const auto& path : o.path)
        if (path.text != "-" && !is_table(path) && !path.text.ends_with(".json") &&
            robot_format(path) == RobotFormat::none)
            problems.add(given.mark, "E-FORMAT", fmt::format("measure cannot write '{}'", path.text),
                         "use a name that ends in .json, .csv, .jsonl, .urdf or .mjcf");
        else if (o.per == Per::face && path.text.ends_with(".jsonl"))
            problems.add(given.mark, "E-FORMAT",
                         fmt::format("a table of faces is a .csv file, found '{}'", path.text),
                         "use a name that ends in .csv, or per: part");
    if (o.per != Per::face && std::none_of(o.path.begin(), o.path.end(), is_table))
        add_refusal(needs("per", "a path that ends in .csv or .jsonl"), "measure", given, problems);
    if (o.with && !compares(o))
        add_refusal(needs("with", "the attribute deviation"), "measure", given, problems);
    if (given.find("missing") && o.attributes.empty())
        add_refusal(needs("missing", "attributes"), "measure", given, problems);
}

StageFiles files_of_measure(const MeasureOptions& o) {
    StageFiles files{{}, o.path};
    if (o.with) files.inputs.push_back(*o.with);
    return files;
}

bool is_from_load(const MeasureOptions& o) { return !o.with && compares(o); }

bool is_table(const PathText& path) { return path.text.ends_with(".csv") || path.text.ends_with(".jsonl"); }

bool lists_faces(const MeasureOptions& o) {
    return o.per == Per::face && std::any_of(o.path.begin(), o.path.end(), is_table);
}

bool lists_models(const MeasureOptions& o) {
    return o.per != Per::face && std::any_of(o.path.begin(), o.path.end(), is_table);
}

} // namespace facetmill::measure_stage

namespace facetmill {

using measure_stage::QuantityName;

bool OptionType<QuantityName>::parse(const Value& value, QuantityName& out, Problems& problems) {
    if (value.deferred) return true;
    out.quantity = value.is_scalar() ? quantity_named(value.text) : nullptr;
    if (out.quantity) return true;
    const Quantity* called = value.is_scalar() ? quantity_called(value.text) : nullptr;
    problems.add(value.mark, "E-CHOICE",
                 fmt::format("'attributes' accepts {}, found {}", fmt::join(quantity_names(), ", "),
                             value.described()),
                 called ? fmt::format("'{}' is called '{}' here", value.text, called->name)
                        : did_you_mean(value.text, quantity_words()));
    return false;
}

std::string OptionType<QuantityName>::print(const QuantityName& name) {
    return name.quantity ? std::string(name.quantity->name) : "";
}

Json OptionType<QuantityName>::schema() { return {{"enum", quantity_names()}}; }

} // namespace facetmill
