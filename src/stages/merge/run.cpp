#include "base/text/unique_names.hpp"
#include "base/text/words.hpp"
#include "io/flatten.hpp"
#include "io/gltf/gltf.hpp"
#include "mesh/skin.hpp"
#include "mesh/transform.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/stage.hpp"
#include "stages/merge/help.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <map>

namespace facetmill::merge_stage {

namespace {

struct MergeOptions {
    enum class Attributes { keep, none };

    std::string name;
    bool weld = false;
    Attributes attributes = Attributes::keep;
};

void declare(Declare<MergeOptions>& d) {
    d.option("name", &MergeOptions::name, "The name of the joined part. Default: the name of the first part.")
        .primary();
    d.option("weld", &MergeOptions::weld, "Merges vertices at exactly the same position.")
        .also_called(weld_synonyms);
    d.choice<MergeOptions::Attributes>(
        "attributes", &MergeOptions::attributes,
        {{"keep", MergeOptions::Attributes::keep, "attributes and materials of all parts"},
         {"none", MergeOptions::Attributes::none,
          "only the surface, without seams, for stages that make new attributes: unwrap and bake"}},
        "The attributes of the joined part.");
}

/// Parts that stay because merging would change what viewers show of them.
struct StayingParts {
    std::string reason;
    std::vector<std::string> parts;
};

struct MergeReport {
    std::optional<std::string> part;
    std::optional<std::size_t> welded_vertices;
    std::vector<std::string> merged;
    std::vector<StayingParts> staying;
};

void declare_report(DeclareFields<MergeReport>& d) {
    d.field("part", &MergeReport::part, "The name of the joined part.").only_when("a part was merged");
    d.field("welded_vertices", &MergeReport::welded_vertices, "Vertices merged into others.")
        .only_when("a part was merged");
    d.field("merged", &MergeReport::merged, "The names of the joined parts, in order.");
    d.list("staying", &MergeReport::staying, "Selected parts that stay unchanged.",
           [](DeclareFields<StayingParts>& s) {
               s.field("reason", &StayingParts::reason, "Why they stay, for example animated or hidden.");
               s.field("parts", &StayingParts::parts, "The names of the parts.");
           });
    d.tell([](const MergeReport& r) {
        std::vector<std::string> lines{
            r.part ? fmt::format("joined {} into '{}'", counted(r.merged.size(), "part"), *r.part)
                   : "joined no parts"};
        for (const StayingParts& s : r.staying)
            lines.push_back(
                fmt::format("not joined: {} {} ({})", s.parts.size(), s.reason, io::some_of(s.parts)));
        return lines;
    });
}

/// Numbers the faces by their original part, for `separate: group`.
void mark_group(Mesh& mesh, std::uint32_t number) {
    mesh.drop("group", Domain::face);
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false,
                               std::vector<std::uint32_t>(mesh.face_count(), number)});
}

/// Drops attributes, seams and materials.
void drop_attributes(Mesh& mesh) {
    mesh.attributes.clear();
    mesh.primitives.clear();
    mesh.line_primitive.clear();
    for (std::vector<Index>* wedges : {&mesh.corners, &mesh.lines})
        for (Index& w : *wedges) w = mesh.vertex_of_wedge(w);
    mesh.wedge_vertex.clear();
}

std::string name_beside(const std::vector<Part>& others, const std::string& wanted) {
    return free_name(wanted, [&](const std::string& name) {
        return std::any_of(others.begin(), others.end(), [&](const Part& part) { return part.name == name; });
    });
}

constexpr const char* placed_several_times = "placed several times by EXT_mesh_gpu_instancing";

/// The reason why merging would change the look of a part in viewers; null if it would not.
const char* reason_to_stay(const io::PartView& view) {
    if (view.animated) return "animated";
    if (view.hidden) return "hidden";
    if (view.lower_level || view.has_levels) return "linked to levels of detail";
    if (view.instanced) return placed_several_times;
    return nullptr;
}

/// [parts] true for the selected parts that are merged. Warns about the others.
std::vector<bool> parts_to_merge(const Scene& scene, Context& context, MergeReport& report) {
    const std::vector<io::PartView> views = io::part_views(scene);
    std::vector<bool> chosen;
    chosen.reserve(scene.parts.size());
    std::map<std::string_view, std::vector<std::string>> staying; // names by reason
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        const bool selected = context.selects(scene.parts[i], scene);
        const char* reason = selected ? reason_to_stay(views[i]) : nullptr;
        if (reason) staying[reason].push_back(io::one_line(scene.parts[i].name));
        chosen.push_back(selected && !reason);
    }
    for (const auto& [reason, names] : staying) {
        report.staying.push_back({std::string(reason), names});
        context.warn("W-MERGE-STAYS",
                     fmt::format("merge: {} {} and {} not merged: {}",
                                 names.size() == 1 ? "a part is" : counted(names.size(), "part") + " are",
                                 reason, names.size() == 1 ? "is" : "are", io::some_of(names)),
                     reason == placed_several_times
                         ? "load: {instances: expand} makes a part of each"
                         : "to merge them in their rest pose, write the scene to PLY, which has no nodes, "
                           "and load that");
    }
    return chosen;
}

/// Volumes of glass keep their thickness in the world, although their meshes grow.
void keep_thickness(Scene& scene, const std::vector<bool>& chosen, Context& context) {
    const auto thick = io::thicknesses(scene);
    std::vector<io::LengthGrowth> growth(scene.parts.size());
    for (std::size_t i = 0; i < growth.size(); ++i) {
        const Part& part = scene.parts[i];
        if (!chosen[i] || thick[i].empty()) continue;
        growth[i].mesh = io::length_growth(part.transform);
        if (!is_similarity(part.transform))
            context.warn("W-VOLUME",
                         fmt::format("merge: the scale of part '{}' differs by direction, so the thickness "
                                     "of its volume uses the mean of the three scales",
                                     part.name),
                         "leave it out with `only`");
    }
    io::scale_material_lengths(scene, growth);
}

Scene run(Scene scene, const MergeOptions& o, Context& context, MergeReport& report) {
    const std::vector<bool> chosen = parts_to_merge(scene, context, report);
    keep_thickness(scene, chosen, context);
    std::vector<Part> rest;
    std::optional<Part> joined;
    std::size_t place = 0;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
        Part& part = scene.parts[i];
        if (!chosen[i]) {
            rest.push_back(std::move(part));
            continue;
        }
        apply(part.mesh, part.transform);
        if (part.skinned)
            context.warn("W-SKIN",
                         fmt::format("merge: part '{}' is in bind pose and loses its skin", part.name),
                         "exclude it with `only`, or write the parts without merge");
        context.attribute_changes(part, drop_skin(part.mesh, "merged parts have no skin"));
        mark_group(part.mesh, static_cast<std::uint32_t>(report.merged.size()));
        report.merged.push_back(part.name);
        const bool keeps = o.attributes == MergeOptions::Attributes::keep;
        using Kind = AttributeChange::Kind;
        for (const auto& a : part.mesh.attributes)
            context.attribute_changes(
                part, {{a.name, a.domain, keeps ? Kind::kept : Kind::dropped,
                        keeps ? "other parts get white, their own normals, nan, or zero" : "as asked"}});
        if (!keeps) drop_attributes(part.mesh);
        if (joined) {
            append(joined->mesh, part.mesh);
            continue;
        }
        place = rest.size();
        joined = Part{part.name, std::move(part.mesh), {}, -1, -1, -1, false, true};
    }
    if (joined) {
        const std::size_t welded = o.weld ? weld_exact(joined->mesh) : 0;
        if (!o.name.empty()) joined->name = name_beside(rest, o.name);
        report.part = joined->name;
        report.welded_vertices = welded;
        rest.insert(rest.begin() + static_cast<std::ptrdiff_t>(place), std::move(*joined));
    }
    scene.parts = std::move(rest);
    return scene;
}

const RegisterStage registered =
    make_stage<StageOf<run>>({.name = "merge",
                              .also_called = "join concatenate append",
                              .about = help::merge::about,
                              .details = help::merge::details,
                              .examples = {"merge", "merge: body", "merge: {weld: true}"},
                              .lines = LinesPolicy::pass},
                             declare, declare_report);

} // namespace

} // namespace facetmill::merge_stage
