#include "stages/relax/options.hpp"

#include "options/mark_at.hpp"

#include <fmt/format.h>

namespace facetmill::relax_stage {

namespace {

using Boundary = RelaxSettings::Boundary;
using Method = RelaxSettings::Method;
using Neighbours = RelaxSettings::Neighbours;

/// The maximum number of iterations with until.
constexpr std::int64_t max_iterations_until = 1000;
/// The default alpha of hc with until. With alpha 0, hc would shrink the mesh in the end.
constexpr double alpha_until = 0.1;

void declare_methods(Declare<RelaxOptions>& d) {
    d.choice<std::optional<Method>>(
        "method", &RelaxOptions::method,
        {{"laplacian", Method::laplacian, "to the mean of the neighbours: smooths fast, shrinks the surface"},
         {"taubin", Method::taubin, "alternating steps inward and outward: removes noise, hardly shrinks"},
         {"cotangent", Method::cotangent, "neighbours weighted by cotangents: faces keep their shapes"},
         {"implicit", Method::implicit, "one linear system per iteration: stable for any lambda"},
         {"hc", Method::hc, "to the mean and partly back: nearly keeps the volume"}},
        "How vertices move: laplacian unless given, or with until hc, which converges to a smooth surface of "
        "nearly the same volume.");
    d.option("lambda", &RelaxOptions::lambda,
             "How far each vertex moves towards the mean of its neighbours; 1 is all the way (a ratio, "
             "without unit; 1 unless given, 0.5 for taubin, which needs less than 0.7; implicit takes any "
             "value, and 10 smooths about as much as 10 iterations).")
        .also_called("strength factor weight")
        .above(0)
        .at_most(1e6);
    d.option("pass_band", &RelaxOptions::pass_band,
             "taubin: the pass-band frequency k_PB; lower frequencies of the surface are kept (a ratio, "
             "without unit).")
        .above(0)
        .below(1);
    d.option(
         "alpha", &RelaxOptions::alpha,
         "hc: how strongly vertices are pulled back towards the original surface (a ratio, without unit; 0 "
         "unless given, 0.1 with until).")
        .between(0, 1);
    d.option("beta", &RelaxOptions::beta,
             "hc: how much of the step back comes from the vertex's own difference; the rest comes from its "
             "neighbours (a ratio, without unit).")
        .between(0, 1);
}

void declare_limits(Declare<RelaxOptions>& d) {
    d.choice<Neighbours>(
        "neighbours", &RelaxOptions::neighbours,
        {{"faces", Neighbours::faces,
          "the vertices of all faces that share the vertex, each once; the opposite corner of a quad counts"},
         {"edges", Neighbours::edges, "the vertices joined to it by an edge"}},
        "Which vertices count as neighbours.");
    d.choice<Boundary>(
        "boundary", &RelaxOptions::boundary,
        {{"fixed", Boundary::fixed, "they stay in place, and so does the boundary of an open surface"},
         {"slide", Boundary::slide,
          "they are averaged with their neighbours along the boundary only; its corners become round unless "
          "feature_angle holds them"},
         {"free", Boundary::free, "they move like all others; an open surface shrinks"}},
        "How boundary vertices move: those on an edge with exactly one face.");
    d.option("feature_angle", &RelaxOptions::feature_angle,
             "Edges whose dihedral angle is larger than this are features and are kept (an angle between the "
             "normals of the two faces): vertices on them move along them only, and stay where feature lines "
             "end, meet or turn by more than this angle; with slide the boundary is such a line. Edges with "
             "three or more faces are features as well.")
        .between(0, 180);
    d.option("until", &RelaxOptions::until,
             "Stops when no vertex has moved farther than this in an iteration (a length, such as 0.01%); "
             "iterations is then the maximum, 1000 unless given. A warning says when that was not enough, or "
             "when relaxation stopped early: laplacian, cotangent and implicit would shrink a closed surface "
             "to a point, so they stop before a third of its area is lost.")
        .above(0);
    declare_caps(d, &RelaxOptions::caps);
    d.group("mask", &RelaxOptions::mask, mask_help, declare_mask);
}

} // namespace

void declare_relax(Declare<RelaxOptions>& d) {
    d.option(
         "iterations", &RelaxOptions::iterations,
         "The number of iterations (a count; 1 unless given, 1000 with until); 0 leaves the mesh as it is.")
        .also_called("steps passes iters n")
        .between(0, 1000000)
        .primary();
    declare_methods(d);
    declare_limits(d);
}

RelaxSettings relax_settings(const RelaxOptions& o) {
    RelaxSettings s;
    s.iterations = o.iterations.value_or(o.until ? max_iterations_until : 1);
    s.method = o.method.value_or(o.until ? Method::hc : Method::laplacian);
    s.lambda = o.lambda;
    s.neighbours = o.neighbours;
    s.boundary = o.boundary;
    if (o.feature_angle) s.feature_angle = o.feature_angle->radians;
    s.pass_band = o.pass_band;
    s.alpha = o.alpha.value_or(o.until ? alpha_until : s.alpha);
    s.beta = o.beta;
    return s;
}

void verify_relax(const RelaxOptions& o, const Value& given, Problems& problems) {
    const RelaxSettings settings = relax_settings(o);
    add_refusal(check_relax_settings(settings), "relax", given, problems);
    const auto belongs = [&](const char* name, Method method, const char* to) {
        if (given.is_map() && given.find(name) && settings.method != method)
            add_refusal(Refusal{name, fmt::format("'{}' goes with the method {} only", name, to)}, "relax",
                        given, problems);
    };
    belongs("pass_band", Method::taubin, "taubin");
    belongs("alpha", Method::hc, "hc");
    belongs("beta", Method::hc, "hc");
    if (given.is_map() && given.find("neighbours") && settings.method == Method::cotangent)
        add_refusal(Refusal{"neighbours", "'neighbours' does not go with the method cotangent, which weights "
                                          "those by angles"},
                    "relax", given, problems);
}

} // namespace facetmill::relax_stage
