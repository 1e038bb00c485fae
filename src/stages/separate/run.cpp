#include "base/text/unique_names.hpp"
#include "geometry/edit/surgery.hpp"
#include "stages/separate/help.hpp"
#include "stages/separate/options.hpp"

#include <fmt/format.h>

namespace facetmill::separate_stage {

namespace {

struct SeparatedPart {
    std::string part;
    std::size_t parts = 0;
};

struct SeparateReport {
    std::size_t parts = 0;
    std::vector<SeparatedPart> separated;
};

void declare_report(DeclareFields<SeparateReport>& d) {
    d.field("parts", &SeparateReport::parts, "The number of parts in the scene after this stage.");
    d.list("separated", &SeparateReport::separated, "Each part that was separated.",
           [](DeclareFields<SeparatedPart>& p) {
               p.field("part", &SeparatedPart::part, "The original name of the part.");
               p.field("parts", &SeparatedPart::parts, "The number of parts made from it.");
           });
}

/// Refuses more parts than max_parts.
void require_few(std::size_t parts, std::int64_t max_parts) {
    if (parts > static_cast<std::size_t>(max_parts))
        throw Error(
            ErrorKind::stage, "E-PARTS",
            fmt::format("separate: there would be at least {} parts, but max_parts is {}", parts, max_parts),
            "use clean: {components: {min_faces: 10}} first to remove small components, or raise max_parts");
}

/// The first piece keeps the part's node, and the others become siblings. All keep its skin and animation.
Part part_of(const Part& part, Mesh mesh, std::string name) {
    Part piece;
    piece.name = std::move(name);
    piece.mesh = std::move(mesh);
    piece.transform = part.transform;
    piece.skinned = part.skinned;
    piece.document = part.document;
    piece.node = part.node;
    piece.source_mesh = part.source_mesh;
    piece.changed = true;
    return piece;
}

Scene run(Scene scene, const SeparateOptions& o, Context& context, SeparateReport& report) {
    std::vector<Part> parts;
    UniqueNames names;
    for (const Part& part : scene.parts)
        if (!context.selects(part, scene)) names.take(part.name);
    for (Part& part : scene.parts) {
        const FaceLabels labels = context.selects(part, scene) ? face_labels(part, scene, o) : FaceLabels{};
        if (labels.names.size() < 2) {
            if (context.selects(part, scene)) part.name = names.add(part.name);
            parts.push_back(std::move(part));
            continue;
        }
        require_few(parts.size() + labels.names.size(), o.max_parts);
        context.attribute_changes(part, kept_changes(part.mesh.attributes));
        auto pieces = separated_with_primitives(std::move(part.mesh), labels.of_face, labels.names.size());
        report.separated.push_back({part.name, labels.names.size()});
        for (std::size_t i = 0; i < pieces.size(); ++i)
            parts.push_back(part_of(part, std::move(pieces[i]), names.add(labels.names[i])));
    }
    scene.parts = std::move(parts);
    report.parts = scene.parts.size();
    return scene;
}

struct SeparateStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        verify_separate(o, given, problems);
    }
};

const RegisterStage registered = make_stage<SeparateStage>(
    {.name = "separate",
     .also_called = "explode components",
     .about = help::separate::about,
     .details = help::separate::details,
     .examples = {"separate", "separate: material", "separate: {by: group, attribute: cut_id}"},
     .lines = LinesPolicy::pass},
    declare_separate, declare_report);

} // namespace

} // namespace facetmill::separate_stage
