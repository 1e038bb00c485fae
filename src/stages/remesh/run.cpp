#include "base/text/words.hpp"
#include "geometry/deviation/deviation.hpp"
#include "geometry/remesh/remesh.hpp"
#include "geometry/triangulate/crossing_faces.hpp"
#include "mesh/transform.hpp"
#include "options/mark_at.hpp"
#include "stage/stage.hpp"
#include "stages/remesh/help.hpp"

#include <fmt/format.h>

namespace facetmill::remesh_stage {

namespace {

struct RemeshOptions {
    std::optional<Length> length, tolerance, min_length, max_length;
    Angle feature_angle = Angle::degrees(45);
    std::int64_t iterations = RemeshSettings{}.iterations;
    bool measure = true;
};

void declare(Declare<RemeshOptions>& d) {
    d.option("length", &RemeshOptions::length, "The edge length, for example 1mm or 1%.")
        .also_called("edge_length target_length target_edge_length targetlen size edge")
        .above(0)
        .primary();
    d.option("tolerance", &RemeshOptions::tolerance,
             "The intended distance of the faces from the surface. Edge lengths then follow the curvature.")
        .also_called("error max_error adaptive")
        .above(0);
    d.option("min_length", &RemeshOptions::min_length,
             "With tolerance: the shortest intended edge. Default: the tolerance.")
        .above(0);
    d.option("max_length", &RemeshOptions::max_length,
             "With tolerance: the longest intended edge. Default: 5% of the part's diagonal.")
        .above(0);
    d.option("feature_angle", &RemeshOptions::feature_angle,
             "Edges stay sharp if the normals of their two faces differ by more than this angle.")
        .also_called("crease featuredeg sharp_angle angle")
        .between(0, 180);
    d.option("iterations", &RemeshOptions::iterations,
             "The number of iterations. More iterations make the triangles more even.")
        .also_called("steps passes iters n")
        .between(1, 100);
    d.option("measure", &RemeshOptions::measure, "Measures the deviation from the input.");
    d.exactly_one({"length", "tolerance"});
}

struct RemeshedPart {
    std::string part;
    std::size_t faces_before = 0, faces = 0, feature_edges = 0, locked_edges = 0;
    double shortest = 0, mean = 0, longest = 0;
    std::optional<double> deviation;
};

struct RemeshReport {
    std::vector<RemeshedPart> parts;
};

void declare_part(DeclareFields<RemeshedPart>& d) {
    d.field("part", &RemeshedPart::part, "The name of the part.");
    d.field("faces_before", &RemeshedPart::faces_before, "Triangles before.");
    d.field("faces", &RemeshedPart::faces, "Triangles after.");
    d.field("feature_edges", &RemeshedPart::feature_edges,
            "Edges of the result that are boundaries, sharp edges, seams or borders of materials.");
    d.field("locked_edges", &RemeshedPart::locked_edges,
            "Non-manifold edges of the input. They are split and not otherwise changed.");
    d.field("shortest_edge", &RemeshedPart::shortest, "The length of the shortest edge.").unit("scene units");
    d.field("mean_edge", &RemeshedPart::mean, "The mean length of the edges.").unit("scene units");
    d.field("longest_edge", &RemeshedPart::longest, "The length of the longest edge.").unit("scene units");
    d.field("deviation", &RemeshedPart::deviation,
            "The largest measured distance between input and result, both ways.")
        .unit("scene units")
        .only_when("it is measured");
}

void declare_report(DeclareFields<RemeshReport>& d) {
    d.list("parts", &RemeshReport::parts, "Each remeshed part.", declare_part);
    d.tell([](const RemeshReport& r) {
        std::vector<std::string> lines;
        lines.reserve(r.parts.size());
        for (const RemeshedPart& p : r.parts)
            lines.push_back(fmt::format("{}: edges {:.4g} to {:.4g}, {:.4g} on average{}", p.part, p.shortest,
                                        p.longest, p.mean,
                                        p.deviation ? fmt::format("; deviation {:.4g}", *p.deviation) : ""));
        return lines;
    });
}

/// Remeshes parts in their own space, or in the world if their transform is no similarity.
class PartRemesher {
  public:
    PartRemesher(const RemeshOptions& o, const Scene& scene, Context& context)
        : o_(o), scene_(scene), context_(context) {}

    RemeshedPart operator()(Part& part) const {
        const bool in_world = !is_similarity(part.transform);
        const auto back = in_world ? inverse(part.transform) : std::nullopt;
        const double stretch = back ? 1 : mean_stretch(part.transform);
        const RemeshSettings settings = settings_for(part, stretch);
        RemeshedPart result{part.name, 0, 0, 0, 0, 0, 0, 0, {}};
        if (!(settings.length > 0) && !(settings.tolerance > 0)) { // a share of a diagonal without extent
            warn_of_no_area(part);
            return result;
        }
        Mesh mesh = triangles_of(part.mesh);
        part.mesh = {};
        if (back) apply(mesh, part.transform);
        result.faces_before = mesh.face_count();
        const Surface before = o_.measure ? surface_of(mesh) : Surface{};
        RemeshResult r = remesh(std::move(mesh), settings);
        if (o_.measure)
            result.deviation = stretch * deviation(before, surface_of(r.mesh), {.means = false}).maximum();
        if (back) apply(r.mesh, *back);
        part.mesh = std::move(r.mesh);
        result.faces = part.mesh.face_count();
        result.feature_edges = r.feature_edges;
        result.locked_edges = r.locked_edges;
        result.shortest = r.shortest * stretch;
        result.mean = r.mean * stretch;
        result.longest = r.longest * stretch;
        context_.attribute_changes(part, r.changes);
        warn(part, r, result, settings.tolerance * stretch);
        return result;
    }

  private:
    RemeshSettings settings_for(const Part& part, double stretch) const {
        const auto local = [&](const std::optional<Length>& l, const char* option) {
            return l ? context_.resolve(*l, scene_, option, &part) / stretch : 0;
        };
        RemeshSettings s;
        s.length = local(o_.length, "length");
        s.tolerance = local(o_.tolerance, "tolerance");
        s.min_length = local(o_.min_length, "min_length");
        s.max_length = local(o_.max_length, "max_length");
        s.feature_angle = o_.feature_angle.radians;
        s.iterations = static_cast<int>(o_.iterations);
        return s;
    }

    void warn_of_no_area(const Part& part) const {
        context_.warn(
            "W-REMESH-NO-AREA",
            fmt::format("remesh: part '{}' stays unchanged, because its faces have no area", part.name),
            "remove such faces with clean");
    }

    void warn(const Part& part, const RemeshResult& r, const RemeshedPart& result, double tolerance) const {
        if (!(r.expected_faces > 0) && result.faces_before > 0) warn_of_no_area(part);
        if (r.intersections > 0 && !r.input_intersects)
            context_.warn("W-REMESH-INTERSECTS",
                          fmt::format("remesh: {} of part '{}' intersect",
                                      counted(r.intersections, "pair of faces", "pairs of faces"), part.name),
                          o_.length ? "give a shorter length" : "give a smaller tolerance or min_length");
        if (tolerance > 0 && result.deviation && *result.deviation > tolerance)
            context_.warn("W-REMESH-TOLERANCE",
                          fmt::format("remesh: part '{}' is up to {:.4g} from the input, more than the "
                                      "tolerance {:.4g}",
                                      part.name, *result.deviation, tolerance),
                          fmt::format("give tolerance: {:.3g}", tolerance * tolerance / *result.deviation));
    }

    const RemeshOptions& o_;
    const Scene& scene_;
    Context& context_;
};

Scene run(Scene scene, const RemeshOptions& o, Context& context, RemeshReport& report) {
    context.for_each_part(scene, [&](Part& part) {
        if (part.mesh.face_count() == 0) return;
        report.parts.push_back(PartRemesher(o, scene, context)(part));
    });
    return scene;
}

struct RemeshStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        for (const char* name : {"min_length", "max_length"})
            if (given.is_map() && given.find(name) && !o.tolerance)
                add_refusal(Refusal{name, fmt::format("'{}' needs 'tolerance'", name),
                                    "give tolerance instead of length"},
                            "remesh", given, problems);
    }
};

const RegisterStage registered = make_stage<RemeshStage>(
    {.name = "remesh",
     .also_called = "remeshing isotropic_remesh isotropic_remeshing isotropic_explicit_remeshing retopo "
                    "retopology",
     .about = help::remesh::about,
     .details = help::remesh::details,
     .examples = {"remesh: 1%", "remesh: {length: 2mm, feature_angle: 30deg}",
                  "remesh: {tolerance: 0.05%, max_length: 3%}"},
     .leaves_points = true,
     .may_lose = MayLose::half,
     .crossing_faces = CrossingFacePolicy::fill},
    declare, declare_report);

} // namespace

} // namespace facetmill::remesh_stage
