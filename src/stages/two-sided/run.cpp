#include "geometry/thicken/thicken.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

enum class By { faces, material };

struct TwoSidedOptions {
    By by = By::faces;
};

void declare(Declare<TwoSidedOptions>& d) {
    d.choice<By>("by", &TwoSidedOptions::by,
                 {{"faces", By::faces, "every face once more, in reversed order"},
                  {"material", By::material, "materials are marked double-sided, faces stay as they are"}},
                 "How the back becomes visible.")
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
    d.list("parts", &TwoSidedReport::parts, "Each part whose faces were doubled.",
           [](DeclareFields<DoubledPart>& p) {
               p.field("part", &DoubledPart::part, "Its name.");
               p.field("new_faces", &DoubledPart::new_faces, "Faces in reversed order that were added.");
           })
        .only_when("by: faces");
}

/// The number of the material, made when there is none.
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
        context.ledger(part, r.fates);
        parts.push_back({part.name, r.mesh.face_count() - part.mesh.face_count()});
        part.mesh = std::move(r.mesh);
    });
    return scene;
}

const RegisterStage registered = make_stage<TwoSidedOptions>(
    {.name = "two-sided",
     .about = "Makes a surface visible from behind: by doubled faces, or by its material.",
     .details = "By faces, every face is there once more in reversed order, after all others, with normals "
                "turned; those that have a back at the same place already stay as they are. The back "
                "has its own vertices, except along open edges, which both sides share: an open surface "
                "becomes a closed one "
                "without volume. Files that are welded by position (STL, glTF) will have both sides share "
                "all of them. By "
                "material, glTF's doubleSided is set on every material of the parts; only glTF can say that. "
                "thicken gives a "
                "surface a real back.\n\nSource: the note on facets.",
     .examples = {"two-sided", "two-sided: material"}},
    declare, declare_report, run);

} // namespace

} // namespace facetmill
