#include "base/text/unique_names.hpp"
#include "mesh/transform.hpp"
#include "stages/hull/help.hpp"
#include "stages/hull/report.hpp"

#include <fmt/format.h>

namespace facetmill::hull_stage {

namespace {

/// Makes the shapes of parts, with the errors and warnings that name them.
class ShapeMaker {
  public:
    ShapeMaker(const HullOptions& o, Context& context, HullReport& report)
        : o_(o), context_(context), report_(report) {}

    /// Adds the shape of the points to the parts. of: the part whose node the shape uses.
    void add(std::span<const Vec3> points, const Part& of, std::vector<Part>& parts) {
        HullResult hull =
            convex_hull(points, {o_.shape, static_cast<std::size_t>(o_.max_vertices.value_or(0))});
        check(hull, of.name);
        add_shape(std::move(hull), collider_name(o_, of.name), of, parts);
    }

    UniqueNames& names() { return names_; }

  private:
    void add_shape(HullResult hull, const std::string& name, const Part& of, std::vector<Part>& parts) {
        Part shape;
        shape.name = names_.add(name);
        shape.transform = of.transform;
        shape.document = of.document;
        shape.node = of.node;
        shape.source_mesh = of.source_mesh;
        shape.changed = true;
        report_.shapes.push_back(report_of(hull, of.transform));
        report_.shapes.back().part = of.name;
        report_.shapes.back().name = shape.name;
        shape.mesh = std::move(hull.mesh);
        parts.push_back(std::move(shape));
    }
    void check(const HullResult& hull, const std::string& part) {
        if (hull.dimension == HullDimension::plane && o_.shape == HullShape::hull)
            context_.warn("W-HULL-FLAT",
                          fmt::format("hull: part '{}' is flat, so its hull has no volume", part),
                          "use thicken first to give it a volume");
        if (hull.dimension >= HullDimension::plane) return;
        throw Error(ErrorKind::stage, "E-HULL",
                    fmt::format("hull: part '{}' has no hull, because {}", part,
                                hull.dimension == HullDimension::none    ? "it has no points"
                                : hull.dimension == HullDimension::point ? "all its points coincide"
                                                                         : "all its points are on a line"),
                    fmt::format("exclude it: only: [\"!{}\"]", part));
    }

    const HullOptions& o_;
    Context& context_;
    HullReport& report_;
    UniqueNames names_;
};

void require_similarity(const HullOptions& o, const Part& part) {
    if (o.shape == HullShape::hull || is_similarity(part.transform)) return;
    throw Error(
        ErrorKind::stage, "E-HULL",
        fmt::format("hull: the node of part '{}' scales directions differently, so it would distort the "
                    "shape",
                    part.name),
        "use transform: {bake: true} first");
}

void tell_dropped(const Part& part, Context& context) {
    AttributeChanges changes;
    for (const auto& a : part.mesh.attributes)
        changes.push_back(
            {a.name, a.domain, AttributeChange::Kind::dropped, "convex shapes have no attributes"});
    context.attribute_changes(part, changes);
}

/// One shape around all selected parts, in world space.
void wrap_scene(Scene& scene, const HullOptions& o, Context& context, ShapeMaker& maker) {
    std::vector<Vec3> points;
    std::vector<Part> parts;
    Part whole;
    for (Part& part : scene.parts) {
        if (!context.selects(part, scene)) {
            parts.push_back(std::move(part));
            continue;
        }
        if (whole.name.empty()) whole.name = part.name;
        for (const Vec3& p : hull_points(part.mesh)) points.push_back(part.transform.point(p));
        if (o.keep)
            parts.push_back(std::move(part));
        else
            tell_dropped(part, context);
    }
    maker.add(points, whole, parts);
    scene.parts = std::move(parts);
}

Scene run(Scene scene, const HullOptions& o, Context& context, HullReport& report) {
    ShapeMaker maker(o, context, report);
    bool any = false;
    for (const Part& part : scene.parts) {
        const bool selected = context.selects(part, scene);
        any = any || selected;
        if (!selected || o.keep) maker.names().take(part.name);
        if (selected && part.skinned)
            context.warn(
                "W-SKIN",
                fmt::format("hull: the hull of part '{}' is in bind pose, without its skin", part.name));
    }
    if (!any) return scene;
    if (o.per == HullOptions::Per::scene) {
        wrap_scene(scene, o, context, maker);
        return scene;
    }
    std::vector<Part> parts;
    for (Part& part : scene.parts) {
        if (!context.selects(part, scene)) {
            parts.push_back(std::move(part));
            continue;
        }
        require_similarity(o, part);
        std::vector<Part> shapes;
        maker.add(hull_points(part.mesh), part, shapes);
        if (o.keep)
            parts.push_back(std::move(part));
        else
            tell_dropped(part, context);
        for (Part& shape : shapes) parts.push_back(std::move(shape));
    }
    scene.parts = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<StageOf<run>>(
    {.name = "hull",
     .also_called = "convex_hull convexhull collision collider bounding_box obb qhull",
     .about = help::hull::about,
     .details = help::hull::details,
     .examples = {"hull", "hull: {max_vertices: 64, engine: unreal, keep: true}", "hull: box",
                  "hull: {shape: sphere, per: scene}"},
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all},
    declare_hull, declare_hull_report);

} // namespace

} // namespace facetmill::hull_stage
