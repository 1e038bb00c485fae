#include "base/text/unique_names.hpp"
#include "mesh/skin.hpp"
#include "stage/options/synonyms.hpp"
#include "stage/stage.hpp"
#include "stages/merge/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::merge_stage {

namespace {

struct MergeOptions {
    std::string name;
    bool weld = false;
};

void declare(Declare<MergeOptions>& d) {
    d.option("name", &MergeOptions::name, "The name of the joined part. Default: the name of the first part.")
        .primary();
    d.option("weld", &MergeOptions::weld, "Merges vertices at exactly the same position.")
        .also_called(weld_synonyms);
}

struct MergeReport {
    std::optional<std::string> part;
    std::optional<std::size_t> welded_vertices;
    std::vector<std::string> merged;
};

void declare_report(DeclareFields<MergeReport>& d) {
    d.field("part", &MergeReport::part, "The name of the joined part.").only_when("a part was selected");
    d.field("welded_vertices", &MergeReport::welded_vertices, "Vertices merged into others.")
        .only_when("a part was selected");
    d.field("merged", &MergeReport::merged, "The names of the joined parts, in order.");
}

/// Numbers the faces by their original part, for `separate: group`.
void mark_group(Mesh& mesh, std::uint32_t number) {
    mesh.drop("group", Domain::face);
    mesh.attributes.push_back({"group", Domain::face, Role::index, 1, false,
                               std::vector<std::uint32_t>(mesh.face_count(), number)});
}

std::string name_beside(const std::vector<Part>& others, const std::string& wanted) {
    return free_name(wanted, [&](const std::string& name) {
        return std::any_of(others.begin(), others.end(), [&](const Part& part) { return part.name == name; });
    });
}

Scene run(Scene scene, const MergeOptions& o, Context& context, MergeReport& report) {
    std::vector<Part> rest;
    std::optional<Part> joined;
    std::size_t place = 0;
    for (Part& part : scene.parts) {
        if (!context.selects(part, scene)) {
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
        for (const auto& a : part.mesh.attributes)
            context.attribute_changes(part, {{a.name, a.domain, AttributeChange::Kind::kept,
                                              "other parts get white, their own normals, nan, or zero"}});
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
