#include "geometry/orient/orient.hpp"

#include "base/text/readable_numbers.hpp"
#include "base/text/words.hpp"
#include "mesh/placement.hpp"
#include "stage/stage.hpp"
#include "stages/orient/help.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::orient_stage {

namespace {

void declare(Declare<OrientSettings>& d) {
    d.choice<OrientMethod>(
         "method", &OrientSettings::method,
         {{"outward", OrientMethod::outward, "neighbours become consistent, and the front faces outward"},
          {"consistent", OrientMethod::consistent,
           "neighbours become consistent, and most faces keep their front"},
          {"flip", OrientMethod::flip, "every face is reversed"}},
         "How to orient faces.")
        .primary();
    d.choice<Nested>("nested", &OrientSettings::nested,
                     {{"cavities", Nested::cavities, "it is a cavity, so its front faces the hollow"},
                      {"solids", Nested::solids, "it is a separate solid"}},
                     "The meaning of a closed component inside another one (with outward).");
}

struct OrientedPart {
    std::string part;
    std::size_t flipped_faces = 0, components = 0, closed = 0, nested = 0, non_orientable = 0, undecided = 0;
};

struct OrientReport {
    std::vector<OrientedPart> parts;
};

void declare_part(DeclareFields<OrientedPart>& d) {
    d.field("part", &OrientedPart::part, "The name of the part.");
    d.field("flipped_faces", &OrientedPart::flipped_faces, "Faces that were reversed.");
    d.field("components", &OrientedPart::components, "Components, connected through edges with two faces.");
    d.field("closed_components", &OrientedPart::closed, "Closed components.");
    d.field("nested_components", &OrientedPart::nested, "Components inside another component.");
    d.field("non_orientable_components", &OrientedPart::non_orientable,
            "Components that stayed unchanged because they cannot be oriented.");
    d.field("undecided_components", &OrientedPart::undecided, "Components without a clear outside.");
}

void declare_report(DeclareFields<OrientReport>& d) {
    d.list("parts", &OrientReport::parts, "Each oriented part.", declare_part).tallied("no faces");
}

OrientedPart counts_of(const Part& part, const OrientResult& r) {
    const auto count = [&](auto&& is) {
        return static_cast<std::size_t>(std::count_if(r.components.begin(), r.components.end(), is));
    };
    using Component = OrientedComponent;
    return {part.name,
            r.flipped,
            r.components.size(),
            count([](const Component& p) { return p.closed; }),
            count([](const Component& p) { return p.depth > 0; }),
            count([](const Component& p) { return !p.orientable; }),
            count([](const Component& p) { return p.undecided; })};
}

/// Warns of components that could not be oriented, or whose outside is uncertain.
void warn(const Part& part, const OrientResult& r, Context& context) {
    std::size_t crossed = 0, undecided = 0;
    const OrientedComponent* first = nullptr;
    for (const auto& p : r.components) {
        if (!p.orientable && crossed++ == 0) first = &p;
        undecided += p.undecided;
    }
    if (crossed > 0) {
        const Vec3 at = in_world(part, first->conflict);
        context.warn("W-ORIENT",
                     fmt::format("orient: {} of part '{}' cannot be oriented, like a Moebius strip, and "
                                 "stayed unchanged; neighbours cannot be consistent at ({})",
                                 counted(crossed, "component"), part.name, readable(at, ", ")),
                     "cut it there, or use two-sided");
    }
    if (undecided > 0)
        context.warn("W-ORIENT-OPEN",
                     fmt::format("orient: {} of part '{}' without a clear outside: only made consistent",
                                 counted(undecided, "component"), part.name),
                     "use method: flip to reverse them");
}

Scene run(Scene scene, const OrientSettings& settings, Context& context, OrientReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        OrientResult r = orient(std::move(part.mesh), settings);
        part.mesh = std::move(r.mesh);
        context.attribute_changes(part, r.changes);
        warn(part, r, context);
        report.parts.push_back(counts_of(part, r));
    });
    return scene;
}

const RegisterStage registered = make_stage<StageOf<run>>(
    {.name = "orient",
     .also_called = "flip invert fix_normals reorient",
     .about = help::orient::about,
     .details = help::orient::details,
     .examples = {"orient", "orient: consistent", "orient: flip", "orient: {nested: solids}"},
     .lines = LinesPolicy::pass},
    declare, declare_report);

} // namespace

} // namespace facetmill::orient_stage
