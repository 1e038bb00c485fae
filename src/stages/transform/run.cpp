#include "base/math/portable_math.hpp"
#include "base/text/readable_numbers.hpp"
#include "cells/process/inspect_cells.hpp"
#include "geometry/globe/globe.hpp"
#include "io/gltf/gltf.hpp"
#include "io/gltf/read/skinned_pose.hpp"
#include "mesh/placement.hpp"
#include "mesh/transform.hpp"
#include "parallel/parallel.hpp"
#include "stage/bind_pose.hpp"
#include "stages/transform/help.hpp"
#include "stages/transform/report.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::transform_stage {

namespace {

Transform moved(const Vec3& by) {
    Transform t;
    for (int i = 0; i < 3; ++i) t.m[i][3] = by[static_cast<std::size_t>(i)];
    return t;
}

Transform uniform(double factor) {
    Transform t;
    for (std::size_t i = 0; i < 3; ++i) t.m[i][i] = factor;
    return t;
}

/// The reason why baking would change the look in viewers; null if it would not.
const char* reason_to_keep_node(const io::PartView& view, bool uneven_thickness) {
    if (view.animated) return "is animated";
    if (view.instanced) return "has several instances";
    if (view.shares_node) return "has a camera, a light or another extension at its node";
    if (uneven_thickness) return "has a material with a thickness and a scale that differs by direction";
    return nullptr;
}

ReportedPlace reported(const Geodetic& place) {
    constexpr double degrees = 180 / pi;
    return {place.latitude * degrees, place.longitude * degrees, place.height, geocentric(place)};
}

/// Refuses coordinates that are not in the system.
void check_coordinates(const Box& box, const ProjectedSystem& system, const std::string& crs) {
    const bool degrees = box.min.x >= -180 && box.max.x <= 180 && box.min.y >= -90 && box.max.y <= 90;
    if (!degrees && system.may_hold(box.min) && system.may_hold(box.max)) return;
    throw Error(ErrorKind::stage, "E-CRS",
                fmt::format("transform: the scene reaches from ({}) to ({}), which {} in {}",
                            readable(box.min, ", "), readable(box.max, ", "),
                            degrees ? "seems to be in degrees or near its own origin, not" : "is not", crs),
                degrees ? "convert degrees to UTM first, or use place for a scene near its own origin"
                        : "check the zone, and that x is the easting and y the northing");
}

/// Converts the vertices, and turns normals and tangents with the grid.
void project_mesh(Mesh& mesh, const ProjectedSystem& system, const Vec3& geoid) {
    std::vector<Vec3> from = mesh.positions;
    parallel_for(from.size(), [&](std::size_t v) {
        from[v] += geoid;
        mesh.positions[v] = system.geocentric(from[v]);
    });
    for (Attribute& a : mesh.attributes) {
        if (a.domain != Domain::wedge || !(a.role == Role::normal || a.role == Role::tangent)) continue;
        parallel_for(a.size(), [&](std::size_t w) {
            const Vec3 turned = system.frame_at(from[mesh.vertex_of_wedge(static_cast<Index>(w))])
                                    .vector({a.value(w, 0), a.value(w, 1), a.value(w, 2)});
            for (int c = 0; c < 3; ++c) a.set_value(w, c, turned[static_cast<std::size_t>(c)]);
        });
    }
}

class Mover {
  public:
    /// The box of the only part after a transform, for a scene whose mesh is not in memory.
    using BoxOf = std::function<Box(const Transform&)>;
    Mover(Scene& scene, const TransformOptions& o, Context& context, BoxOf box = {})
        : scene_(scene), o_(o), context_(context), box_(std::move(box)) {}

    TransformReport run() {
        const bool globe = o_.place || !o_.crs.empty();
        const io::Conversion converted =
            io::convert(scene_, {globe ? Unit::m : o_.unit, globe ? UpAxis::z : o_.up});
        if (o_.crs.empty()) { // a coordinate system states the unit and the axis
            TransformOptions target = o_;
            if (globe) target.unit = Unit::m;
            if (globe) target.up = UpAxis::z;
            warn_of_conversion(converted, target, context_);
        }
        std::optional<ReportedPlace> on_globe;
        if (!o_.crs.empty()) on_globe = project();
        const Transform spin = spin_of(o_);
        const Vec3 fixed = pivot();
        if (!spin.identity()) move(moved(fixed) * spin * moved(-fixed));
        if (!o_.matrix.empty()) move(matrix_of(o_));
        const std::optional<PrintDirectionResult> orientation = orient();
        const std::optional<double> fit = fit_factor();
        if (fit) move(moved(pivot()) * uniform(*fit) * moved(-pivot()));
        if (!o_.translate.empty()) move(moved(translation()));
        if (o_.centre && !box().empty()) move(moved(-box().centre()));
        if ((o_.ground || orientation) && !box().empty()) move(moved(drop()));
        if (o_.place) on_globe = put_on_globe();
        if (o_.bake) bake();
        if (keys_kept_) warn_of_kept_keys(context_);
        return {
            all_, converted.factor, fit, orientation, on_globe, to_string(scene_.unit), to_string(scene_.up)};
    }

  private:
    Vec3 pivot() const {
        const Box all = o_.pivot == TransformOptions::Pivot::centre ? box() : Box{};
        return all.empty() ? Vec3{} : all.centre();
    }

    /// A percentage without another reference refers to the current side.
    static Length of_own_side(const Length& side, double own) {
        if (side.kind != Length::Kind::percent || side.of != Length::Of::stage) return side;
        Length length = Length::scene(side.amount / 100 * own);
        length.text = side.text;
        return length;
    }

    /// The factor that scales the box to fit. Sides of length 0 always fit.
    std::optional<double> fit_factor() const {
        if (o_.fit.empty() || box().empty()) return {};
        const Vec3 extent = box().max - box().min;
        double factor = HUGE_VAL;
        for (std::size_t i = 0; i < 3; ++i) {
            const Length& side = o_.fit[o_.fit.size() == 1 ? 0 : i];
            const bool one = o_.fit.size() == 1;
            const double own = one ? std::max({extent.x, extent.y, extent.z}) : extent[i];
            const double length = context_.resolve(of_own_side(side, own), scene_,
                                                   one ? "fit" : fmt::format("fit.{}", "xyz"[i]));
            if (extent[i] > 0) factor = std::min(factor, length / extent[i]);
        }
        if (!(factor > 0) || !std::isfinite(factor))
            throw Error(ErrorKind::stage, "E-TRANSFORM",
                        "transform: fit cannot scale the parts because their bounding box has no extent",
                        "print the bounds with facetmill info");
        return o_.shrink_only ? std::min(factor, 1.0) : factor;
    }

    /// Turns the parts for printing, all together.
    std::optional<PrintDirectionResult> orient() {
        if (o_.orient_for == TransformOptions::Purpose::none) return {};
        std::vector<const Part*> parts;
        for (const Part& part : scene_.parts)
            if (context_.selects(part, scene_) && part.mesh.face_count() > 0) parts.push_back(&part);
        const Surface surface = surface_of(parts);
        if (surface.size() == 0) return {};
        const Vec3 up = up_vector();
        const PrintDirectionResult found = find_print_direction(surface, up, {o_.overhang_angle.radians});
        move(moved(pivot()) * turn_onto(found.after.up, up) * moved(-pivot()));
        return found;
    }

    Vec3 up_vector() const { return scene_.up == UpAxis::y ? Vec3{0, 1, 0} : Vec3{0, 0, 1}; }

    Vec3 translation() const {
        Vec3 by;
        for (std::size_t i = 0; i < o_.translate.size(); ++i)
            by[i] = context_.resolve(o_.translate[i], scene_, fmt::format("translate.{}", "xyz"[i]));
        return by;
    }

    /// The translation that puts the parts on the ground.
    Vec3 drop() const {
        const Vec3 up = up_vector();
        return up * -dot(up, box().min);
    }

    Box box() const {
        if (box_) return box_(scene_.parts.front().transform);
        std::vector<bool> selected;
        selected.reserve(scene_.parts.size());
        for (const Part& part : scene_.parts) selected.push_back(context_.selects(part, scene_));
        return selected.empty() ? Box{} : io::posed_bounds(scene_, std::move(selected));
    }

    void move(const Transform& t) {
        all_ = t * all_;
        const double growth = io::length_growth(t);
        std::vector<io::LengthGrowth> lengths(scene_.parts.size());
        std::vector<bool> moved(lengths.size());
        for (std::size_t i = 0; i < moved.size(); ++i) {
            Part& part = scene_.parts[i];
            if (!context_.selects(part, scene_)) continue;
            moved[i] = true;
            part.transform = t * part.transform;
            lengths[i] = {part.skinned ? growth : 1, growth};
        }
        io::scale_material_lengths(scene_, lengths);
        keys_kept_ = !io::move_cameras_and_lights(scene_, moved, t) || keys_kept_;
    }

    ReportedPlace put_on_globe() {
        const GlobePlace& p = *o_.place;
        const Geodetic place{p.lat.radians, p.lon.radians,
                             context_.resolve(p.height, scene_, "place.height")};
        move(local_frame(place, p.heading.radians));
        return reported(place);
    }

    /// Converts every vertex from the coordinate system. Cameras and lights move like the centre.
    ReportedPlace project() {
        const auto system = ProjectedSystem::named(o_.crs);
        if (!system) throw Error(ErrorKind::usage, "E-CRS", "transform: the coordinate system is not known");
        const Vec3 geoid{0, 0, o_.geoid ? context_.resolve(*o_.geoid, scene_, "geoid") : 0};
        const Box all = box();
        if (all.empty()) return {};
        check_coordinates(all, *system, o_.crs);
        check_projectable();
        context_.for_each_part(scene_, [&](Part& part) {
            apply(part.mesh, part.transform);
            part.transform = {};
            project_mesh(part.mesh, *system, geoid);
        });
        std::vector<bool> moved_parts;
        moved_parts.reserve(scene_.parts.size());
        for (const Part& part : scene_.parts) moved_parts.push_back(context_.selects(part, scene_));
        const Vec3 centre = all.centre() + geoid;
        const Transform at_centre = system->frame_at(centre) * moved(-all.centre());
        keys_kept_ = !io::move_cameras_and_lights(scene_, moved_parts, at_centre) || keys_kept_;
        all_ = at_centre * all_;
        return reported(system->geodetic(centre));
    }

    void check_projectable() const {
        const auto views = io::part_views(scene_);
        for (std::size_t i = 0; i < scene_.parts.size(); ++i) {
            const Part& part = scene_.parts[i];
            if (!context_.selects(part, scene_)) continue;
            const char* reason = reason_to_keep_node(views[i], false);
            if (!reason && has_poses(part)) reason = "is skinned or morphed";
            if (reason)
                throw Error(
                    ErrorKind::stage, "E-CRS",
                    fmt::format("transform: part '{}' {}, so its vertices cannot be converted one by one",
                                part.name, reason),
                    "use place, which moves the scene as a whole");
        }
    }

    /// Parts whose node has another purpose keep it: an animation would move baked points about another
    /// origin, and instances would be turned and scaled about it.
    void bake() {
        const auto views = io::part_views(scene_);
        const auto thick = io::thicknesses(scene_);
        std::vector<io::LengthGrowth> lengths(scene_.parts.size());
        context_.for_each_part(scene_, [&](Part& part) {
            const auto i = static_cast<std::size_t>(&part - scene_.parts.data());
            if (part.skinned) return;
            const bool uneven = !thick[i].empty() && !is_similarity(part.transform);
            if (const char* reason = reason_to_keep_node(views[i], uneven))
                return warn_of_kept_node(part.name, reason, context_);
            apply(part.mesh, part.transform);
            lengths[i].mesh = io::length_growth(part.transform);
            part.transform = {};
        });
        io::scale_material_lengths(scene_, lengths);
    }

    Scene& scene_;
    const TransformOptions& o_;
    Context& context_;
    BoxOf box_;
    Transform all_;
    bool keys_kept_ = false;
};

Scene run(Scene scene, const TransformOptions& o, Context& context, TransformReport& report) {
    report = Mover(scene, o, context).run();
    return scene;
}

struct TransformStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        verify_transform(o, given, problems);
    }
    void on_cells(CellFlow& flow, Context& context) const override {
        const auto box = [&](const Transform& t) { return cells::box_of_cells(*flow.partition, t); };
        Scene outline = flow.outline();
        const TransformReport report = Mover(outline, o, context, box).run();
        flow.transform = outline.parts.front().transform;
        flow.unit = outline.unit;
        flow.up = outline.up;
        flow.box = box(flow.transform);
        context.report(*info->result, &report);
    }
    std::optional<std::string> why_not_on_cells() const override {
        if (o.orient_for != TransformOptions::Purpose::none) return "orient_for needs all faces in memory";
        if (!o.crs.empty()) return "crs converts every vertex, but cells only move as a whole";
        if (o.bake) return "bake applies node transforms, and cells have no nodes";
        return {};
    }
};

const RegisterStage registered = make_stage<TransformStage>(
    {.name = "transform",
     .also_called = "translate rotate scale resize move center centre mirror convert_units",
     .about = help::transform::about,
     .details = help::transform::details,
     .examples = {"transform: {scale: 0.001}",
                  "transform: {rotate: {axis: [1, 0, 0], angle: 90deg}, ground: true}",
                  "transform: {unit: m, up: y, centre: true, ground: true}",
                  "transform: {fit: 120mm, ground: true}",
                  "transform: {orient_for: printing, fit: [200mm, 200mm, 180mm], shrink_only: true}",
                  "transform: {crs: \"EPSG:25832\", geoid: 47.6m}",
                  "transform: {centre: true, ground: true, place: {lat: 48.8584, lon: 2.2945, height: 80m}}",
                  "transform: {translate: [0, 0, 2mm]}"},
     .moves = true,
     .lines = LinesPolicy::work,
     .may_lose = MayLose::area,
     .roles = {.sets_unit = "unit"}},
    declare_transform, declare_transform_report);

} // namespace

} // namespace facetmill::transform_stage
