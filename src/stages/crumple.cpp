#include "geometry/crumple.hpp"

#include "geometry/split.hpp"
#include "stage/stage.hpp"

namespace facetmill {

namespace {

using Boundary = CrumpleSettings::Boundary;
using Direction = CrumpleSettings::Direction;

struct CrumpleOptions {
    Length amplitude = Length::percent(0.2);
    std::int64_t grid = 3;
    Direction direction = Direction::free;
    Boundary boundary = Boundary::free;
    std::int64_t seed = 0;
    double truncate = 3;
    bool triangulate = false;
};

void declare(Declare<CrumpleOptions>& d) {
    d.option(
         "amplitude", &CrumpleOptions::amplitude,
         "The standard deviation of each displacement (a length; 0.2% of the scene's diagonal unless given).")
        .at_least(0)
        .primary();
    d.option("grid", &CrumpleOptions::grid,
             "How many pieces each edge is cut into before (a count): every face becomes n x n; 1 leaves "
             "them whole.")
        .between(1, 10000);
    d.choice<Direction>("direction", &CrumpleOptions::direction,
                        {{"free", Direction::free, "three independent amounts along x, y and z"},
                         {"normal", Direction::normal, "one amount along the vertex normal"}},
                        "Where vertices go.");
    d.choice<Boundary>(
        "boundary", &CrumpleOptions::boundary,
        {{"free", Boundary::free, "they move as all others"}, {"fixed", Boundary::fixed, "they stay"}},
        "What boundary vertices do: those on an edge with exactly one face.");
    d.option("seed", &CrumpleOptions::seed, "Another seed gives other noise (an integer, without unit).")
        .at_least(0);
    d.option("truncate", &CrumpleOptions::truncate,
             "No amount is larger than this many standard deviations (without unit); the distribution is cut "
             "off there.")
        .between(0.1, 100);
    d.option("triangulate", &CrumpleOptions::triangulate,
             "Cut the quads, which are no longer planar, into triangles along the shorter diagonal.");
}

/// What two steps in a row did to the attributes.
Fates joined(const Fates& first, Fates second) {
    for (auto& fate : second)
        for (const auto& earlier : first)
            if (fate.kind == Fate::Kind::kept && earlier.attribute == fate.attribute &&
                earlier.domain == fate.domain)
                fate = earlier;
    return second;
}

Scene run(Scene scene, const CrumpleOptions& o, Context& context) {
    CrumpleSettings settings{.direction = o.direction,
                             .boundary = o.boundary,
                             .seed = static_cast<std::uint64_t>(o.seed),
                             .truncate = o.truncate,
                             .to_world = {}};
    Json parts = Json::array();
    context.for_each_part(scene, [&](Part& part) {
        settings.amplitude = context.resolve(o.amplitude, scene, "amplitude", &part);
        SplitResult pieces = grid_split(part.mesh, static_cast<int>(o.grid));
        settings.to_world = part.transform;
        CrumpleResult r = crumple(std::move(pieces.mesh), settings);
        part.mesh = o.triangulate ? triangulated(r.mesh) : std::move(r.mesh);
        context.ledger(part, joined(pieces.fates, std::move(r.fates)));
        parts.push_back({{"part", part.name},
                         {"added_faces", pieces.added},
                         {"moved_vertices", r.moved},
                         {"held_vertices", r.held},
                         {"largest_move", r.largest_move},
                         {"root_mean_square_move", r.root_mean_square}});
    });
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<CrumpleOptions>(
    {.name = "crumple",
     .about = "Roughens a surface: faces are split n x n and every vertex is displaced by a Gaussian amount.",
     .details = "Each vertex moves once, by normally distributed amounts of mean 0 and the given standard "
                "deviation, cut off "
                "at `truncate`. Faces that share a vertex move with it, so nothing tears and the topology "
                "stays; faces may "
                "come to intersect when the amplitude is large beside their size.\n\n"
                "The noise at a vertex depends on the seed and on its world position rounded to float32, and "
                "on nothing "
                "else: vertices at one place move together across seams, unwelded copies, parts and files, "
                "and neither the "
                "order of vertices nor the number of threads matters. Along the normal, places shared by "
                "several parts "
                "have a normal in each and may part.\n\n"
                "Splitting interpolates vertex and wedge attributes and copies those of faces; then normals "
                "are recomputed, "
                "tangents made perpendicular to them, and all else is kept. The report has the largest and "
                "the root mean "
                "square displacement, in world units.\n\n"
                "Source: the note 'Geometric crumpling' (1994).",
     .examples = {"crumple: 0.2%", "crumple: {grid: 3, amplitude: 0.5mm, seed: 7}",
                  "crumple: {grid: 1, amplitude: 1%, direction: normal, boundary: fixed}"}},
    declare, run);

} // namespace

} // namespace facetmill
