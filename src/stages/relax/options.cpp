#include "stages/relax/options.hpp"

#include "options/mark_at.hpp"

namespace facetmill {

namespace {

using Boundary = RelaxSettings::Boundary;
using Method = RelaxSettings::Method;
using Neighbours = RelaxSettings::Neighbours;

/// How many iterations there are at most, with until.
constexpr std::int64_t most_until = 1000;

void declare_methods(Declare<RelaxOptions>& d) {
    d.choice<Method>(
        "method", &RelaxOptions::method,
        {{"laplacian", Method::laplacian, "to the mean of the neighbours: smooths fast, shrinks"},
         {"taubin", Method::taubin, "a step in, a step out: removes noise, hardly shrinks"},
         {"cotangent", Method::cotangent, "neighbours weighted by angles: facets keep their shapes"},
         {"implicit", Method::implicit, "a linear system per iteration: large factors in one go"},
         {"hc", Method::hc, "to the mean and pushed back: keeps the volume nearly"}},
        "How vertices move.");
    d.option(
         "factor", &RelaxOptions::factor,
         "How far each vertex goes towards the mean of its neighbours: 1 is all the way (a share, without "
         "unit; 1 unless given, 0.5 for taubin, which needs less than 0.7; implicit takes any, 10 smooths "
         "about as much as 10 iterations).")
        .above(0)
        .at_most(1e6);
    d.option("pass_band", &RelaxOptions::pass_band,
             "taubin: the part of the surface's frequencies that is kept (a share, without unit).")
        .above(0)
        .below(1);
    d.option("original", &RelaxOptions::original,
             "hc: how much the first surface holds on to the vertices (a share, without unit).")
        .between(0, 1);
    d.option("push_back", &RelaxOptions::push_back,
             "hc: the vertex's own share of what pushes it back, the rest being its neighbours' (a share, "
             "without unit).")
        .between(0, 1);
}

void declare_limits(Declare<RelaxOptions>& d) {
    d.choice<Neighbours>(
        "neighbours", &RelaxOptions::neighbours,
        {{"faces", Neighbours::faces,
          "the vertices of all faces that share the vertex, each once: the far corner of a quad counts"},
         {"edges", Neighbours::edges, "the vertices joined to it by an edge"}},
        "Which vertices pull.");
    d.choice<Boundary>(
        "boundary", &RelaxOptions::boundary,
        {{"fixed", Boundary::fixed, "they stay, and so does the outline of an open surface"},
         {"slide", Boundary::slide,
          "they are averaged with their neighbours along the boundary only: its corners become round, unless "
          "features holds them"},
         {"free", Boundary::free, "they move as all others: an open surface shrinks"}},
        "What boundary vertices do: those on an edge with exactly one face.");
    d.option("features", &RelaxOptions::features,
             "Keep edges that bend by more than this (an angle): vertices on them move along them only, and "
             "stay where they end, meet or turn by more; with slide the boundary counts as such a line. "
             "Edges of three and more faces count too.")
        .between(0, 180);
    d.option("until", &RelaxOptions::until,
             "Stop when no vertex moved farther in an iteration (a length, 0.01%); iterations is then the "
             "most there are, 1000 unless given. When that was not enough, a warning says so.")
        .above(0);
    d.group("mask", &RelaxOptions::mask, mask_help, declare_mask);
}

} // namespace

void declare_relax(Declare<RelaxOptions>& d) {
    d.option(
         "iterations", &RelaxOptions::iterations,
         "How many times all vertices move (a count; 1 unless given, with until 1000); 0 leaves the mesh as "
         "it is.")
        .between(0, 1000000)
        .primary();
    declare_methods(d);
    declare_limits(d);
}

RelaxSettings relax_settings(const RelaxOptions& o) {
    RelaxSettings s;
    s.iterations = o.iterations.value_or(o.until ? most_until : 1), s.method = o.method, s.factor = o.factor;
    s.neighbours = o.neighbours, s.boundary = o.boundary;
    if (o.features) s.features = o.features->radians;
    s.pass_band = o.pass_band, s.original = o.original, s.push_back = o.push_back;
    return s;
}

void verify_relax(const RelaxOptions& o, const Value& given, Problems& problems) {
    try {
        check_relax_settings(relax_settings(o));
    } catch (const Error& e) {
        const auto& d = e.diagnostics().front();
        problems.add(mark_at(given, "factor"), d.id, d.message, d.hint);
    }
    const auto belongs = [&](const char* name, Method method, const char* to) {
        if (given.is_map() && given.find(name) && o.method != method)
            problems.add(mark_at(given, name), "E-CONFLICT",
                         std::string("relax: '") + name + "' goes with the method " + to + " only");
    };
    belongs("pass_band", Method::taubin, "taubin");
    belongs("original", Method::hc, "hc");
    belongs("push_back", Method::hc, "hc");
    if (given.is_map() && given.find("neighbours") && o.method == Method::cotangent)
        problems.add(
            mark_at(given, "neighbours"), "E-CONFLICT",
            "relax: 'neighbours' does not go with the method cotangent, which weights those by angles");
}

} // namespace facetmill
