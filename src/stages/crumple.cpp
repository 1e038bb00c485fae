#include "geometry/crumple.hpp"

#include "geometry/moved.hpp"
#include "geometry/split.hpp"
#include "stage/mask_option.hpp"
#include "stage/stage.hpp"

#include <fmt/format.h>

namespace facetmill {

namespace {

using Boundary = CrumpleSettings::Boundary;
using Direction = CrumpleSettings::Direction;
enum class Intersections { allow, avoid, forbid };

struct CrumpleOptions {
    Length amplitude = Length::percent(0.2);
    std::int64_t grid = 3;
    Direction direction = Direction::free;
    Boundary boundary = Boundary::free;
    std::int64_t seed = 0;
    double truncate = 3;
    bool triangulate = false;
    double frequency = 0;
    std::int64_t octaves = 1;
    double roughness = 0.5;
    Intersections self_intersections = Intersections::allow;
    std::optional<MaskSettings> mask;
};

void declare_noise(Declare<CrumpleOptions>& d) {
    d.option(
         "frequency", &CrumpleOptions::frequency,
         "How many bumps there are along the diagonal of the scene (a number without unit): vertices near "
         "each other move alike. 0 moves every vertex on its own, as the note does.")
        .at_least(0);
    d.option("octaves", &CrumpleOptions::octaves,
             "With frequency: how many noises are added, each of twice the frequency of the one before (a "
             "count); several give a fractal surface.")
        .between(1, 32);
    d.option("roughness", &CrumpleOptions::roughness,
             "With octaves: the amount of each beside the one before (a share, without unit).")
        .above(0)
        .at_most(1);
    d.option("seed", &CrumpleOptions::seed, "Another seed gives other noise (an integer, without unit).")
        .at_least(0);
    d.option("truncate", &CrumpleOptions::truncate,
             "No amount is larger than this many standard deviations (without unit); the distribution is cut "
             "off there.")
        .between(0.1, 100);
}

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
    d.choice<Intersections>(
        "self_intersections", &CrumpleOptions::self_intersections,
        {{"allow", Intersections::allow, "faces may come to meet"},
         {"avoid", Intersections::avoid,
          "vertices of faces that would meet go 1/2, 1/4 ... 1/256 of their way, or stay"},
         {"forbid", Intersections::forbid, "fail when faces would meet"}},
        "What happens when faces of a part would run into each other or fold over. With avoid and forbid, "
        "positions are rounded to float32, which is what files hold.");
    d.group("mask", &CrumpleOptions::mask, mask_help, declare_mask);
    declare_noise(d);
    d.option("triangulate", &CrumpleOptions::triangulate,
             "Cut the quads, which are no longer planar, into triangles along the shorter diagonal.");
}

/// A part between being split and being moved.
struct Work {
    Part* part;
    SplitResult pieces;
    std::vector<Vec3> before;
    Transform to_world;
};

CrumpleSettings settings_of(const CrumpleOptions& o, const Scene& scene) {
    CrumpleSettings s;
    s.direction = o.direction, s.boundary = o.boundary;
    s.seed = static_cast<std::uint64_t>(o.seed), s.truncate = o.truncate;
    const double diagonal = scene.bounds().diagonal();
    s.frequency = diagonal > 0 ? o.frequency / diagonal : 0;
    s.octaves = static_cast<int>(o.octaves), s.roughness = o.roughness;
    return s;
}

void refuse(const AvoidResult& r, const std::vector<Work>& works) {
    const std::string& name = works[r.first_sheet].part->name;
    const auto& [a, b] = r.first;
    throw Error(
        ErrorKind::stage, "E-INTERSECTS",
        fmt::format("crumple: {} pairs of faces would run into each other, first {} of part '{}'", r.found,
                    a == b ? fmt::format("face {} into itself", a) : fmt::format("faces {} and {}", a, b),
                    name),
        "use self_intersections: avoid, or a smaller amplitude");
}

Json described(const AvoidResult& r) {
    Json shares = Json::object();
    for (std::size_t i = 0; i < r.shares.size(); ++i)
        shares[i == 0 ? "1" : i + 1 == r.shares.size() ? "0" : fmt::format("1/{}", 1 << i)] = r.shares[i];
    return {{"before", r.exempt}, {"found", r.found}, {"rounds", r.rounds}, {"vertices_by_share", shares}};
}

/// Warns of an amplitude that is larger than the edges: nothing tears, but faces run into each other.
void warn_of_tangles(const Work& work, double amplitude, Context& context) {
    const double edge = mean_edge(work.part->mesh, work.to_world);
    if (!(amplitude > edge && edge > 0)) return;
    context.warn(
        "W-AMPLITUDE",
        fmt::format("crumple: the amplitude {:.3g} is larger than the mean edge {:.3g} of part '{}': faces "
                    "run into each other",
                    amplitude, edge, work.part->name),
        fmt::format("use self_intersections: avoid, or an amplitude below about {:.2g}", edge / 4));
}

/// Moves all vertices, as far as self_intersections lets them.
void move(std::vector<Work>& works, std::vector<CrumpleSheet>& sheets, const CrumpleOptions& o,
          Context& context) {
    if (o.self_intersections != Intersections::allow) {
        const bool forbid = o.self_intersections == Intersections::forbid;
        const AvoidResult r = move_apart(sheets, forbid);
        if (r.left > 0) refuse(r, works);
        context.result()["self_intersections"] = described(r);
        return;
    }
    for (auto& sheet : sheets)
        for (std::size_t v = 0; v < sheet.moves.moves.size(); ++v)
            sheet.mesh->positions[v] += sheet.moves.moves[v];
}

Scene run(Scene scene, const CrumpleOptions& o, Context& context) {
    CrumpleSettings settings = settings_of(o, scene);
    std::vector<Work> works;
    std::vector<CrumpleSheet> sheets;
    context.for_each_part(scene, [&](Part& part) {
        settings.amplitude = context.resolve(o.amplitude, scene, "amplitude", &part);
        settings.to_world = part.skinned ? Transform{} : part.transform;
        SplitResult pieces = grid_split(part.mesh, static_cast<int>(o.grid));
        part.mesh = std::move(pieces.mesh);
        settings.mask = o.mask ? vertex_mask(part, scene, *o.mask) : std::vector<double>{};
        sheets.push_back({&part.mesh, crumple_moves(part.mesh, settings)});
        works.push_back({&part, std::move(pieces), part.mesh.positions, settings.to_world});
        if (o.self_intersections == Intersections::allow && o.frequency == 0)
            warn_of_tangles(works.back(), settings.amplitude, context);
    });
    move(works, sheets, o, context);
    Json parts = Json::array();
    for (std::size_t i = 0; i < works.size(); ++i) {
        Part& part = *works[i].part;
        CrumpleResult r = crumple_settled(std::move(part.mesh), works[i].before, works[i].to_world);
        part.mesh = o.triangulate ? triangulated(r.mesh) : std::move(r.mesh);
        context.ledger(part, joined(works[i].pieces.fates, std::move(r.fates)));
        parts.push_back({{"part", part.name},
                         {"added_faces", works[i].pieces.added},
                         {"moved_vertices", r.moved},
                         {"held_vertices", sheets[i].moves.held},
                         {"largest_move", r.largest_move},
                         {"root_mean_square_move", r.root_mean_square}});
    }
    context.result()["parts"] = std::move(parts);
    return scene;
}

const RegisterStage registered = make_stage<CrumpleOptions>(
    {.name = "crumple",
     .about = "Roughens a surface: faces are split n x n and every vertex is displaced by a Gaussian amount.",
     .details =
         "Each vertex moves once, by normally distributed amounts of mean 0 and the given standard "
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
         "have a normal in each and may part; and a frequency is counted along the scene, so files crumple "
         "alike only when their diagonals are the same.\n\n"
         "With self_intersections: avoid, each place has a share of its move: 1, 1/2 ... 1/256, 0. In every "
         "round all pairs of faces that newly meet, fold over or lose their area are found, exactly, and "
         "their vertices take the next lower share, all at once, until there are none; after eight rounds "
         "the vertices around them too. Pairs that met before are exempt. The report has how many pairs "
         "there would have been and how many vertices got which share. Only faces of the same part are "
         "kept apart.\n\n"
         "Splitting interpolates vertex and wedge attributes and copies those of faces; then normals "
         "are recomputed, "
         "tangents made perpendicular to them, and all else is kept. The report has the largest and "
         "the root mean "
         "square displacement, in world units.\n\n"
         "Source: the note 'Geometric crumpling' (1994).",
     .examples = {"crumple: 0.2%", "crumple: {grid: 3, amplitude: 0.5mm, seed: 7}",
                  "crumple: {grid: 1, amplitude: 1%, direction: normal, boundary: fixed}",
                  "crumple: {grid: 4, amplitude: 1%, self_intersections: avoid}",
                  "crumple: {grid: 8, amplitude: 2%, frequency: 4, octaves: 6, direction: normal}"}},
    declare, run);

} // namespace

} // namespace facetmill
