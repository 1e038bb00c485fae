#include "stages/crumple/options.hpp"

#include "geometry/inspect/inspect.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/power_scale.hpp"
#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill::crumple_stage {

namespace {

using Boundary = CrumpleSettings::Boundary;
using Direction = CrumpleSettings::Direction;
using Intersections = CrumpleOptions::Intersections;

void declare_noise(Declare<CrumpleOptions>& d) {
    d.option("frequency", &CrumpleOptions::frequency,
             "The number of bumps along the diagonal of the scene. Vertices near each other move alike. 0 "
             "moves every vertex independently.")
        .at_least(0);
    d.option("octaves", &CrumpleOptions::octaves,
             "With frequency: the number of noise functions to add, each with twice the frequency of the "
             "previous one. Several octaves give a fractal surface.")
        .between(1, 32);
    d.option("roughness", &CrumpleOptions::roughness,
             "With frequency and octaves: the amplitude of each octave relative to the previous octave.")
        .above(0)
        .at_most(1);
    d.option("seed", &CrumpleOptions::seed, "The seed of the random numbers.").at_least(0);
    d.option("truncate", &CrumpleOptions::truncate,
             "The distribution is cut off at this many standard deviations.")
        .between(0.1, 100);
}

} // namespace

void declare_crumple(Declare<CrumpleOptions>& d) {
    d.option("amplitude", &CrumpleOptions::amplitude,
             "The standard deviation of each displacement. Default: 0.2% of the scene's diagonal.")
        .at_least(0)
        .primary();
    d.option("grid", &CrumpleOptions::grid,
             "The number of segments that each edge is split into. Every face becomes n x n faces. 1 keeps "
             "faces whole.")
        .between(1, 10000);
    d.choice<Direction>("direction", &CrumpleOptions::direction,
                        {{"free", Direction::free, "three independent amounts along x, y and z"},
                         {"normal", Direction::normal, "one amount along the vertex normal"}},
                        "The direction of the displacement.");
    d.choice<Boundary>("boundary", &CrumpleOptions::boundary,
                       {{"free", Boundary::free, "boundary vertices move like all others"},
                        {"fixed", Boundary::fixed, "boundary vertices do not move"}},
                       "How to handle boundary vertices. A vertex is on the boundary if it is on an edge "
                       "with exactly one face; unwelded copies count as one vertex.");
    d.choice<Intersections>("self_intersections", &CrumpleOptions::self_intersections,
                            {{"allow", Intersections::allow, "faces may intersect"},
                             {"avoid", Intersections::avoid,
                              "vertices of faces that would intersect move by 1/2, 1/4 ... 1/256 of their "
                              "displacement, or not at all"},
                             {"forbid", Intersections::forbid, "the stage fails if faces would intersect"}},
                            "How to handle faces of a part that would intersect or fold over. With avoid and "
                            "forbid, positions are rounded to float32, the precision of most files.")
        .also_called(property_named("self_intersections")->also_called);
    declare_caps(d, &CrumpleOptions::caps);
    d.group("mask", &CrumpleOptions::mask, mask_help, declare_mask);
    declare_noise(d);
    d.option("triangulate", &CrumpleOptions::triangulate,
             "Cuts non-planar quads into triangles along their shorter diagonal.");
}

void verify_crumple(const CrumpleOptions& o, const Value& given, Problems& problems) {
    if (!given.is_map() || o.frequency > 0) return;
    const Value* frequency = given.find("frequency");
    if (frequency && frequency->deferred) return;
    for (const char* name : {"octaves", "roughness"})
        if (given.find(name))
            add_refusal(Refusal{name, fmt::format("'{}' needs a frequency above 0", name),
                                "for example frequency: 4, or remove it"},
                        "crumple", given, problems);
}

CrumpleSettings crumple_settings(const CrumpleOptions& o, const Scene& scene, double amplitude) {
    CrumpleSettings s;
    s.direction = o.direction;
    s.boundary = o.boundary;
    s.seed = static_cast<std::uint64_t>(o.seed);
    s.truncate = o.truncate;
    const double whole = diagonal(scene.bounds());
    s.frequency = whole > 0 ? o.frequency / whole : 0;
    s.octaves = static_cast<int>(o.octaves);
    s.roughness = o.roughness;
    // The test uses the amplitude and not the size of the scene, so that adjacent files agree. Avoiding
    // intersections always rounds positions to float32.
    if (o.self_intersections == CrumpleOptions::Intersections::allow && whole > 0 &&
        0.5 * float32_ulp(scene.bounds()) > amplitude / 100)
        s.places = PositionRounding::far;
    return s;
}

} // namespace facetmill::crumple_stage
