#include "mesh/equal_meshes.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "stages/thicken/help.hpp"
#include "stages/thicken/report.hpp"

#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace facetmill::thicken_stage {

namespace {

using Mode = ThickenOptions::Mode;

/// Thickens surfaces. Parts that differ only by a move are processed once.
class SurfaceThickener {
  public:
    SurfaceThickener(const Scene& scene, const ThickenOptions& o)
        : scene_(scene), o_(o), shapes_(distinct_shapes(scene)) {}

    ThickenedPart operator()(Part& part, double thickness, Context& context) {
        auto [r, drained, origin] = result_for(part, thickness, context);
        part.mesh = std::move(r.mesh);
        context.attribute_changes(part, r.changes);
        const bool has_faces = part.mesh.face_count() > 0;
        if (has_faces) warn_of_walls(part, r, {thickness, scene_.unit}, o_, context);
        if (drained && has_faces) warn_of_cavities(part, *drained, context);
        return ThickenedSurface{part.name,  std::move(r), has_faces,
                                o_.looks(), scene_.unit,  std::move(drained)};
    }

  private:
    struct Known {
        ThickenResult result;
        std::optional<DrainResult> drained; ///< without its mesh
        Vec3 origin;                        ///< the source part's origin in world space
    };

    Known result_for(const Part& part, double thickness, Context& context) {
        const std::size_t as = shapes_.first[static_cast<std::size_t>(&part - scene_.parts.data())];
        const Vec3 origin = in_world(part, {});
        const auto make = [&] {
            Known known{
                thicken(part.mesh, {thickness, o_.side, o_.miter_limit, o_.looks(), part.transform,
                                    o_.self_intersections == ThickenOptions::SelfIntersections::resolve}),
                {},
                origin};
            if (o_.drain) drill(known, part, context);
            return known;
        };
        if (shapes_.uses[as] == 1) return make();
        Known& known = known_[{as, key_of(thickness)}];
        if (known.result.mesh.positions.empty()) known = make();
        Known moved = known;
        const Vec3 by = origin - known.origin;
        if (moved.result.first_turned) *moved.result.first_turned += by;
        if (moved.drained)
            for (DrainHole& hole : moved.drained->holes) {
                hole.from += by;
                hole.to += by;
            }
        return moved;
    }

    void drill(Known& known, const Part& part, Context& context) const {
        DrainSettings settings;
        settings.diameter = context.resolve(o_.drain->diameter, scene_, "drain.diameter", &part);
        if (!(settings.diameter > 0))
            throw Error(ErrorKind::stage, "E-THICKEN", "thicken: the diameter of drain is 0 in this scene",
                        "give a length in scene units");
        settings.count = static_cast<std::size_t>(o_.drain->count);
        settings.vent = o_.drain->vent;
        if (scene_.up == UpAxis::y) settings.up = {0, 1, 0};
        settings.to_world = part.transform;
        DrainResult drained = drain(std::move(known.result.mesh), settings);
        known.result.mesh = std::exchange(drained.mesh, {});
        if (!drained.holes.empty()) // otherwise the mesh is unchanged
            known.result.changes =
                changes_in_sequence(known.result.changes, std::exchange(drained.changes, {}));
        known.drained = std::move(drained);
    }

    const Scene& scene_;
    const ThickenOptions& o_;
    DistinctParts shapes_;
    std::map<std::pair<std::size_t, std::uint64_t>, Known>
        known_; ///< the key is the first equal part and the thickness
};

ThickenedPart thicken_edges(Part& part, const ThickenOptions& o, double thickness, Context& context) {
    WiresResult r = wires(
        part.mesh, {thickness, static_cast<int>(o.sides), o.mode == Mode::boundary_edges, part.transform});
    AttributeChanges changes;
    for (const auto& a : part.mesh.attributes)
        changes.push_back({a.name, a.domain, AttributeChange::Kind::dropped, "cylinders have no attributes"});
    context.attribute_changes(part, changes);
    part.mesh = std::move(r.mesh);
    if (std::exchange(part.skinned, false)) {
        context.warn(
            "W-SKIN",
            fmt::format("thicken: the cylinders of part '{}' are in bind pose, without its skin", part.name));
    }
    return ThickenedEdges{part.name, r.edges, r.skipped};
}

Scene run(Scene scene, const ThickenOptions& o, Context& context, ThickenReport& report) {
    std::optional<SurfaceThickener> thicken_surface;
    if (o.mode == Mode::surface) thicken_surface.emplace(scene, o);
    context.for_each_part(scene, [&](Part& part) {
        const double thickness = context.resolve(o.thickness, scene, "thickness", &part);
        if (!inverse(part.transform))
            throw Error(ErrorKind::stage, "E-THICKEN",
                        fmt::format("thicken: part '{}' is flattened by its node", part.name),
                        "use transform: {bake: true} to make it a flat mesh");
        if (!(thickness > 0))
            throw Error(ErrorKind::stage, "E-THICKEN", "thicken: the thickness is 0 in this scene",
                        "give a length in scene units");
        report.parts.push_back(thicken_surface ? (*thicken_surface)(part, thickness, context)
                                               : thicken_edges(part, o, thickness, context));
    });
    return scene;
}

struct ThickenStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override { verify_thicken(o, given, problems); }
    /// Wires use only the edges of faces.
    CrossingFacePolicy crossing_faces() const override {
        return o.mode == Mode::surface ? CrossingFacePolicy::fill : CrossingFacePolicy::keep;
    }
};

const RegisterStage registered = make_stage<ThickenStage>(
    {.name = "thicken",
     .also_called = "shell hollow offset solidify wireframe",
     .about = help::thicken::about,
     .details = help::thicken::details,
     .examples = {"thicken: 2mm", "thicken: {thickness: 1%, side: centred}",
                  "thicken: {thickness: 0.5%, mode: edges, sides: 6}",
                  "thicken: {thickness: 2mm, drain: {diameter: 5mm, count: 2, vent: true}}"},
     .leaves_points = true,
     .may_lose = MayLose::area,
     .crossing_faces = CrossingFacePolicy::fill},
    declare_thicken, declare_thicken_report);

} // namespace

} // namespace facetmill::thicken_stage
