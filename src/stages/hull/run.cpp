#include "base/text/unique_names.hpp"
#include "geometry/hull/convex_parts.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"
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
        HullResult hull = convex_hull(points, settings(0));
        check(hull, of.name);
        add_shape(std::move(hull), collider_name(o_, of.name, std::nullopt), of, parts);
    }

    /// Adds the shapes around the convex parts of a mesh.
    void add_divided(const Mesh& mesh, double concavity, const Part& of, std::vector<Part>& parts) {
        const double stretch = mean_stretch(of.transform);
        const ConvexPartsResult divided =
            convex_parts(mesh, {static_cast<std::size_t>(o_.max_parts), concavity / stretch});
        if (divided.parts.empty())
            throw Error(
                ErrorKind::stage, "E-HULL",
                fmt::format("hull: part '{}' has no faces with a size, so it cannot be divided", of.name),
                fmt::format("exclude it: only: [\"!{}\"]", of.name));
        std::vector<HullResult> hulls(divided.parts.size());
        parallel_for(
            hulls.size(),
            [&](std::size_t i) { hulls[i] = convex_hull(divided.parts[i].points, settings(divided.margin)); },
            1);
        for (std::size_t i = 0; i < hulls.size(); ++i) {
            const auto number = hulls.size() > 1 ? std::optional(i) : std::nullopt;
            add_shape(std::move(hulls[i]), collider_name(o_, of.name, number), of, parts);
            report_.shapes.back().concavity = divided.parts[i].concavity * stretch;
            report_.shapes.back().resolution = divided.resolution * stretch;
        }
    }

    UniqueNames& names() { return names_; }

  private:
    HullSettings settings(double margin) const {
        return {o_.shape, static_cast<std::size_t>(o_.max_vertices.value_or(0)), margin};
    }
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
    if ((o.shape == HullShape::hull && o.max_parts == 1) || is_similarity(part.transform)) return;
    throw Error(
        ErrorKind::stage, "E-HULL",
        fmt::format("hull: the node of part '{}' scales directions differently, so it would distort {}",
                    part.name, o.shape == HullShape::hull ? "distances" : "the shape"),
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
    Mesh mesh;
    std::vector<Part> parts;
    Part whole;
    const double concavity = o.max_parts > 1 ? context.resolve(o.concavity, scene, "concavity") : 0;
    for (Part& part : scene.parts) {
        if (!context.selects(part, scene)) {
            parts.push_back(std::move(part));
            continue;
        }
        if (whole.name.empty()) whole.name = part.name;
        if (o.max_parts > 1)
            append(mesh, in_world(part));
        else
            for (const Vec3& p : hull_points(part.mesh)) points.push_back(part.transform.point(p));
        if (o.keep)
            parts.push_back(std::move(part));
        else
            tell_dropped(part, context);
    }
    if (o.max_parts > 1)
        maker.add_divided(mesh, concavity, whole, parts);
    else
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
        if (o.max_parts > 1)
            maker.add_divided(part.mesh, context.resolve(o.concavity, scene, "concavity", &part), part,
                              shapes);
        else
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
     .also_called = "convex_hull convexhull convex_parts decompose vhacd coacd collision collider "
                    "bounding_box obb qhull",
     .about = help::hull::about,
     .details = help::hull::details,
     .examples = {"hull", "hull: {max_vertices: 64, engine: unreal, keep: true}", "hull: box",
                  "hull: {max_parts: 16, concavity: 2%, max_vertices: 32}",
                  "hull: {shape: sphere, per: scene}"},
     .lines = LinesPolicy::work,
     .may_lose = MayLose::all},
    declare_hull, declare_hull_report);

} // namespace

} // namespace facetmill::hull_stage
