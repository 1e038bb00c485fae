#include "geometry/deviation.hpp"
#include "geometry/stretch.hpp"
#include "mesh/placement.hpp"
#include "report/deviation_json.hpp"
#include "report/simplify_json.hpp"
#include "stage/simplify_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Stop = SimplifyResult::Stop;

/// A part's share of a count that is meant for all, rounded down; a part may have none.
std::optional<std::size_t> share(std::optional<std::int64_t> whole, std::size_t own, std::size_t all) {
    if (!whole) return {};
    if (own == all || all == 0) return static_cast<std::size_t>(*whole);
    return static_cast<std::size_t>(static_cast<double>(*whole) *
                                    (static_cast<double>(own) / static_cast<double>(all)));
}

std::size_t triangle_count(const Mesh& mesh) { return mesh.corner_count() - 2 * mesh.face_count(); }

void warn(const Part& part, const SimplifyResult& r, Context& context) {
    if (r.stop == Stop::nothing)
        context.warn(
            "W-SIMPLIFY-NOTHING",
            fmt::format("part '{}' has {} triangles and {} vertices, at or below the target: nothing to do",
                        part.name, r.faces_before, r.vertices_before));
    if (r.stop == Stop::stuck)
        context.warn("W-SIMPLIFY-STOPPED",
                     fmt::format("part '{}' stopped at {} triangles, above the target: {}", part.name,
                                 r.faces_after, report::held_by(r)),
                     "ask for more faces, or free what holds them: no locks, fewer seams, a clean mesh, "
                     "topology: allow");
}

class Simplifier {
  public:
    Simplifier(Scene scene, const SimplifyOptions& o, Context& context)
        : scene_(std::move(scene)), o_(o), context_(context) {
        for (const auto& part : scene_.parts)
            if (context.selects(part, scene_))
                faces_ += triangle_count(part.mesh), vertices_ += part.mesh.vertex_count();
        if (o.constraints.hausdorff)
            hausdorff_ = context.resolve(*o.constraints.hausdorff, scene_, "constraints.hausdorff");
        if (o.max_error) max_error_ = context.resolve(*o.max_error, scene_, "max_error");
    }

    Scene run() {
        std::vector<Part> levels;
        context_.for_each_part(scene_, [&](Part& part) {
            if (o_.measure || o_.certify) before_ = surface_of(part);
            if (changes_topology()) topology_ = inspect(part.mesh);
            const Transform to_world = effective(part);
            scale_ = greatest_stretch(to_world);
            const SimplifySettings settings = simplify_settings(o_, to_world, share_of(part.mesh));
            if (!o_.lods) return take(part, simplify(std::move(part.mesh), settings));
            const Part base = part;
            auto results = simplify_levels(std::move(part.mesh), settings);
            for (std::size_t i = 0; i < results.size(); ++i) {
                Part level = base;
                if (i > 0) level.name += fmt::format(".lod{}", i);
                take(level, std::move(results[i]));
                if (i == 0)
                    part = std::move(level);
                else
                    level.changed = true, levels.push_back(std::move(level));
            }
        });
        for (Part& level : levels) scene_.parts.push_back(std::move(level));
        context_.result()["parts"] = std::move(parts_);
        return std::move(scene_);
    }

  private:
    bool changes_topology() const {
        return o_.topology == SimplifySettings::Topology::allow ||
               o_.method == SimplifySettings::Method::cluster;
    }

    SimplifyShare share_of(const Mesh& mesh) const {
        SimplifyShare mine{share(o_.faces, triangle_count(mesh), faces_),
                           share(o_.vertices, mesh.vertex_count(), vertices_), max_error_, hausdorff_};
        for (auto* length : {&mine.max_error, &mine.hausdorff})
            if (*length) **length /= scale_;
        return mine;
    }

    void take(Part& part, SimplifyResult r) {
        part.mesh = std::move(r.mesh);
        context_.ledger(part, r.fates);
        Json entry = report::simplify_json(r, scale_);
        entry["part"] = part.name;
        if (changes_topology())
            entry["topology"] = report::topology_change_json(topology_, inspect(part.mesh));
        if (o_.measure || o_.certify)
            entry["deviation"] =
                report::deviation_json(deviation(before_, surface_of(part), {.certify = o_.certify}));
        parts_.push_back(std::move(entry));
        warn(part, r, context_);
    }

    Scene scene_;
    const SimplifyOptions& o_;
    Context& context_;
    std::size_t faces_ = 0, vertices_ = 0; ///< of all parts selected
    std::optional<double> max_error_, hausdorff_;
    double scale_ = 1;    ///< from the part at hand to the world
    Surface before_;      ///< the part at hand, as it came, in the world
    Properties topology_; ///< of it
    Json parts_ = Json::array();
};

Scene run(Scene scene, const SimplifyOptions& o, Context& context) {
    return Simplifier(std::move(scene), o, context).run();
}

const RegisterStage registered = make_stage<SimplifyOptions>(
    {.name = "simplify",
     .about = "Reduces the number of faces and keeps the shape, the topology and the attributes.",
     .details =
         "Edges are collapsed, cheapest first, until a target is met; with several targets the first one met "
         "stops the work, and the report names it, with the ratio achieved and what holds the edges that are "
         "left. Polygons are triangulated first. The method quadric measures the squared distance to the "
         "planes "
         "of all faces that a vertex stands for, weighted by area; shortest-edge is the note's. Collapses "
         "run in "
         "passes of equal threshold, so the order is that of the costs but for vertices that a pass has "
         "touched "
         "already.\n\n"
         "Guaranteed: a closed manifold stays closed and manifold, genus, components and boundary loops "
         "stay, no "
         "face turns by more than 60 degrees in a collapse, none becomes degenerate or doubled. Boundaries, "
         "UV "
         "seams, sharp normal seams and borders of materials and groups collapse only along themselves and "
         "stay "
         "matched; where several meet, the vertex stays. Non-manifold and inconsistently oriented places are "
         "left as they are. Isolated vertices are dropped. With topology: allow components may vanish, holes "
         "close and handles be pinched off, which can leave edges of four faces; the report has the counts "
         "before and after. The method cluster keeps neither topology nor borders, and says so the same "
         "way.\n\n"
         "UVs, normals, colours and skin weights enter the error of the quadric methods with weights. A "
         "vertex "
         "that moved has the attributes of the surface that came in, at the nearest point of the faces that "
         "it "
         "replaces, so textures do not slide; faces keep theirs. Wedges that differ in normals only are "
         "merged "
         "below the crease angle; a flat-shaded mesh gets the normals of its new faces.\n\n"
         "max_error is a bound on the measured deviation: 100,000 samples each way and all vertices, seed 1, "
         "as "
         "reported under deviation, in scene units and in percent of the part's diagonal. Points of the "
         "surface "
         "are followed while it is simplified, and what is above the bound in the end is taken back collapse "
         "by "
         "collapse. It takes many times as long as a ratio. cluster meets it by the size of its cells.\n\n"
         "lods makes one chain: each level is reached by further collapses from the one before. write: "
         "{path: "
         "x.glb, lods: true} puts them into one file as MSFT_lod, without lods as nodes side by side; only: "
         "\"*.lod1\" writes a level into a file of its own.\n\n"
         "The method constrained keeps boundaries, seams and borders vertex by vertex.\n\n"
         "largest_error is, for quadric and cluster, the largest root mean square distance of a new vertex "
         "to "
         "its planes; for shortest-edge half the longest edge collapsed; for constrained null. A target at "
         "or "
         "above the input does nothing (W-SIMPLIFY-NOTHING); when no collapse is left the work stops and "
         "says "
         "why (W-SIMPLIFY-STOPPED). self_intersections: avoid holds what runs into itself as it came and "
         "does "
         "the rest again, up to 16 times; the count that is left is reported.\n\n"
         "Sources: the note 'Surface simplification' (1997); M. Garland and P. Heckbert, 'Surface "
         "simplification "
         "using quadric error metrics' (1997); H. Hoppe, 'New quadric metric for simplifying meshes with "
         "appearance attributes' (1999); J. Rossignac and P. Borrel (1993) and P. Lindstrom (2000) for "
         "cluster.",
     .examples = {"simplify: 25%", "simplify: {faces: 5000, lock: [boundary, seams]}",
                  "simplify: {ratio: 5%, max_error: 0.1%}", "simplify: {lods: [100%, 50%, 10%]}",
                  "simplify: {ratio: 10%, method: shortest-edge}",
                  "simplify: {ratio: 2%, method: cluster, measure: false}",
                  "simplify: {ratio: 20%, weights: {uv: 2, colour: 0}, topology: allow}"}},
    declare_simplify, run, {.verify = verify_simplify});

} // namespace

} // namespace facetmill
