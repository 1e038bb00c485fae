#include "geometry/crumple.hpp"

#include "base/memory.hpp"
#include "geometry/moved.hpp"
#include "geometry/split.hpp"
#include "mesh/placement.hpp"
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
    d.option(
         "octaves", &CrumpleOptions::octaves,
         "Goes with frequency: how many noises are added, each of twice the frequency of the one before (a "
         "count); several give a fractal surface.")
        .between(1, 32);
    d.option(
         "roughness", &CrumpleOptions::roughness,
         "Goes with frequency and octaves: the amount of each beside the one before (a share, without unit).")
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
        "What boundary vertices do: those on an edge with exactly one face, unwelded copies counted as one.");
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

void verify(const CrumpleOptions& o, const Value& given, Problems& problems) {
    if (!given.is_map() || o.frequency > 0) return;
    const Value* frequency = given.find("frequency");
    if (frequency && frequency->deferred) return;
    for (const char* name : {"octaves", "roughness"})
        if (const Value* value = given.find(name))
            problems.add(value->mark, "E-EXCLUSIVE",
                         fmt::format("crumple: '{}' goes with a frequency above 0 only", name),
                         "for example frequency: 4, or leave it out");
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

/// Where the face of the split mesh was, in world space: the mean of its corners.
Vec3 place_of(const Work& work, Index face) {
    const Mesh& mesh = work.part->mesh;
    Vec3 sum;
    for (Index c = mesh.face_begin(face); c < mesh.face_end(face); ++c) sum += work.before[mesh.vertex(c)];
    return work.to_world.point(sum / mesh.face_size(face));
}

void refuse(const AvoidResult& r, const std::vector<Work>& works, std::int64_t grid) {
    const Work& work = works[r.first_sheet];
    const auto pieces = static_cast<Index>(grid * grid); // of each face, one after the other
    const Index a = r.first.first / pieces, b = r.first.second / pieces;
    const Vec3 p = place_of(work, r.first.first);
    throw Error(
        ErrorKind::stage, "E-INTERSECTS",
        fmt::format("crumple: {} pairs of {} would run into each other, first {} of part '{}', near "
                    "({:.6g}, {:.6g}, {:.6g})",
                    r.found, grid > 1 ? "pieces of faces" : "faces",
                    a == b ? fmt::format("in face {} itself", a) : fmt::format("faces {} and {}", a, b),
                    work.part->name, p.x, p.y, p.z),
        "use self_intersections: avoid, or a smaller amplitude");
}

Json described(const AvoidResult& r) {
    Json shares = Json::object();
    for (std::size_t i = 0; i < r.shares.size(); ++i)
        shares[i == 0 ? "1" : i + 1 == r.shares.size() ? "0" : fmt::format("1/{}", 1 << i)] = r.shares[i];
    return {{"kept_apart", "faces of the same part"},
            {"before", r.exempt},
            {"found", r.found},
            {"rounds", r.rounds},
            {"vertices_by_share", shares}};
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

/// Splits the part, in this stage's words when that cannot be.
SplitResult split_part(const Part& part, std::int64_t grid) {
    try {
        return grid_split(part.mesh, static_cast<int>(grid));
    } catch (const Error& e) {
        auto diagnostics = e.diagnostics();
        for (auto& d : diagnostics) {
            if (d.message.starts_with("split: "))
                d.message = fmt::format("crumple: part '{}', every face split {} x {}: {}", part.name, grid,
                                        grid, d.message.substr(7));
            if (e.kind() == ErrorKind::limit) d.hint = "use a smaller grid, or simplify before";
        }
        throw Error(e.kind(), std::move(diagnostics));
    }
}

/// Refuses before anything is split what could not be kept apart afterwards.
void require_room(const Scene& scene, const CrumpleOptions& o, const Context& context) {
    if (o.self_intersections == Intersections::allow) return;
    double triangles = 0;
    for (const Part& part : scene.parts)
        if (context.selects(part, scene))
            triangles += static_cast<double>(part.mesh.corner_count()) - 2.0 * part.mesh.face_count();
    triangles *= static_cast<double>(o.grid) * static_cast<double>(o.grid);
    require_memory(move_apart_memory(triangles),
                   fmt::format("crumple: keeping {:.3g} triangles apart", triangles),
                   "use a smaller grid, or self_intersections: allow");
}

Box world_box(const Part& part) {
    Box box;
    for (const Vec3& p : part.mesh.positions) box.add(part.skinned ? p : part.transform.point(p));
    return box;
}

/// Warns when parts are so near each other that their faces may have come to meet.
void warn_of_parts(const Scene& scene, Context& context) {
    std::vector<Box> boxes;
    for (const Part& part : scene.parts) boxes.push_back(world_box(part));
    const auto overlap = [&](const Box& a, const Box& b) {
        bool both = !a.empty() && !b.empty();
        for (std::size_t i = 0; i < 3; ++i) both = both && a.min[i] <= b.max[i] && b.min[i] <= a.max[i];
        return both;
    };
    for (std::size_t i = 0; i < boxes.size(); ++i)
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            const Part &a = scene.parts[i], &b = scene.parts[j];
            if (!overlap(boxes[i], boxes[j])) continue;
            if (!context.selects(a, scene) && !context.selects(b, scene)) continue;
            return context.warn("W-CRUMPLE-PARTS",
                                fmt::format("crumple keeps faces of one part apart; the boxes of the parts "
                                            "'{}' and '{}' overlap, so faces of one may meet the other",
                                            a.name, b.name),
                                "merge before it makes one part of them");
        }
}

/// Warns of concave quads, which cannot be split n x n without folds.
void warn_of_folds(const Work& work, Context& context) {
    if (work.pieces.folded > 0)
        context.warn("W-SPLIT-FOLDED",
                     fmt::format("in part '{}' {} faces are concave or cross themselves: their pieces lie "
                                 "over each other",
                                 work.part->name, work.pieces.folded),
                     "triangulate before it");
}

/// Moves all vertices, as far as self_intersections lets them.
void move(std::vector<Work>& works, std::vector<CrumpleSheet>& sheets, const CrumpleOptions& o,
          Context& context) {
    hold_together(sheets);
    if (o.self_intersections != Intersections::allow) {
        const bool forbid = o.self_intersections == Intersections::forbid;
        const AvoidResult r = move_apart(sheets, forbid);
        if (r.left > 0) refuse(r, works, o.grid);
        context.result()["self_intersections"] = described(r);
        return;
    }
    for (auto& sheet : sheets)
        for (std::size_t v = 0; v < sheet.moves.moves.size(); ++v)
            sheet.mesh->positions[v] += sheet.moves.moves[v];
}

Scene run(Scene scene, const CrumpleOptions& o, Context& context) {
    CrumpleSettings settings = settings_of(o, scene);
    require_room(scene, o, context);
    std::vector<Work> works;
    std::vector<CrumpleSheet> sheets;
    MaskOfParts masks(scene, o.mask);
    context.for_each_part(scene, [&](Part& part) {
        settings.amplitude = context.resolve(o.amplitude, scene, "amplitude", &part);
        settings.to_world = effective(part);
        SplitResult pieces = split_part(part, o.grid);
        part.mesh = std::move(pieces.mesh);
        settings.mask = masks.of(part);
        sheets.push_back({&part.mesh, crumple_moves(part.mesh, settings)});
        works.push_back({&part, std::move(pieces), part.mesh.positions, settings.to_world});
        warn_of_folds(works.back(), context);
        if (o.self_intersections == Intersections::allow && o.frequency == 0)
            warn_of_tangles(works.back(), settings.amplitude, context);
    });
    masks.warn_if_idle(context);
    move(works, sheets, o, context);
    if (o.self_intersections != Intersections::allow) warn_of_parts(scene, context);
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
         "stays, with boundary: fixed and under a mask too, where a place moves by the least share of all "
         "vertices there; faces may "
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
         "kept apart (W-CRUMPLE-PARTS warns when others are near), and what they need of memory is refused "
         "before it starts.\n\n"
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
    declare, run, StageHooks<CrumpleOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
