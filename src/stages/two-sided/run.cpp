#include "geometry/thicken/thicken.hpp"
#include "stage/stage.hpp"
#include "stages/two-sided/help.hpp"

#include <fmt/format.h>

namespace facetmill::two_sided_stage {

namespace {

enum class By { faces, material };

struct TwoSidedOptions {
    By by = By::faces;
};

void declare(Declare<TwoSidedOptions>& d) {
    d.choice<By>("by", &TwoSidedOptions::by,
                 {{"faces", By::faces, "add every face once more, in reversed order"},
                  {"material", By::material, "mark materials as double-sided; faces stay unchanged"}},
                 "How to make the back visible.")
        .primary();
}

struct DoubledPart {
    std::string part;
    std::size_t new_faces = 0;
};

struct TwoSidedReport {
    std::optional<std::size_t> marked_materials;
    std::optional<std::vector<DoubledPart>> parts;
};

void declare_report(DeclareFields<TwoSidedReport>& d) {
    d.field("marked_materials", &TwoSidedReport::marked_materials,
            "Materials that were not double-sided before.")
        .only_when("by: material");
    d.list("parts", &TwoSidedReport::parts, "Each part with duplicate faces.",
           [](DeclareFields<DoubledPart>& p) {
               p.field("part", &DoubledPart::part, "The name of the part.");
               p.field("new_faces", &DoubledPart::new_faces, "Added faces in reversed order.");
           })
        .only_when("by: faces");
}

/// Makes a material for faces without any, and returns its index.
Index plain_material(Scene& scene) {
    scene.materials.push_back({.name = "two-sided"});
    return static_cast<Index>(scene.materials.size() - 1);
}

std::size_t mark_materials(Scene& scene, Context& context) {
    std::size_t marked = 0;
    Index plain = none;
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.primitives.empty()) part.mesh.primitives.emplace_back();
        for (auto& primitive : part.mesh.primitives) {
            if (primitive.material >= scene.materials.size())
                primitive.material = plain == none ? (plain = plain_material(scene)) : plain;
            Material& material = scene.materials[primitive.material];
            marked += !material.double_sided;
            material.double_sided = true;
        }
    });
    return marked;
}

Scene run(Scene scene, const TwoSidedOptions& o, Context& context, TwoSidedReport& report) {
    if (o.by == By::material) {
        report.marked_materials = mark_materials(scene, context);
        return scene;
    }
    auto& parts = report.parts.emplace();
    context.for_each_part(scene, [&](Part& part) {
        TwoSidedResult r = two_sided(part.mesh);
        context.attribute_changes(part, r.changes);
        parts.push_back({part.name, r.mesh.face_count() - part.mesh.face_count()});
        part.mesh = std::move(r.mesh);
    });
    return scene;
}

const RegisterStage registered =
    make_stage<StageOf<run>>({.name = "two-sided",
                              .also_called = "double_sided doublesided doubleside",
                              .about = help::two_sided::about,
                              .details = help::two_sided::details,
                              .examples = {"two-sided", "two-sided: material"},
                              .lines = LinesPolicy::pass},
                             declare, declare_report);

} // namespace

} // namespace facetmill::two_sided_stage
