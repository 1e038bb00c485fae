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
        {{"laplacian", Method::laplacian,
          "move to the mean of the neighbours: smooths fast, shrinks the surface"},
         {"taubin", Method::taubin, "alternate steps inward and outward: removes noise, hardly shrinks"},
         {"cotangent", Method::cotangent, "weight neighbours by cotangents: faces keep their shapes"},
         {"implicit", Method::implicit, "solve a linear system in each iteration: stable for any lambda"},
         {"hc", Method::hc, "move to the mean and partly back: nearly preserves the volume"}},
        "The smoothing method. Default: laplacian. With until: hc, which converges to a smooth surface of "
        "nearly the same volume.");
    d.option("lambda", &RelaxOptions::lambda,
             "The fraction of the way to the mean of the neighbours that each vertex moves. Default: 1, or "
             "0.5 for taubin, which needs less than 0.7. implicit accepts any value, and 10 smooths about as "
             "much as 10 iterations.")
        .also_called("strength factor weight")
        .above(0)
        .at_most(1e6);
    d.option("pass_band", &RelaxOptions::pass_band,
             "taubin: the pass-band frequency k_PB. Lower frequencies of the surface are preserved.")
        .above(0)
        .below(1);
    d.option("alpha", &RelaxOptions::alpha,
             "hc: how strongly vertices return to the original surface. Default: 0, or 0.1 with until.")
        .between(0, 1);
    d.option("beta", &RelaxOptions::beta,
             "hc: the share of the step back that depends on the vertex's own difference. The rest depends "
             "on its neighbours.")
        .between(0, 1);
}

void declare_limits(Declare<RelaxOptions>& d) {
    d.choice<Neighbours>(
        "neighbours", &RelaxOptions::neighbours,
        {{"faces", Neighbours::faces,
          "all other vertices of the faces at the vertex, including the opposite corner of a quad"},
         {"edges", Neighbours::edges, "the vertices joined to it by an edge"}},
        "The vertices that count as neighbours.");
    d.choice<Boundary>(
        "boundary", &RelaxOptions::boundary,
        {{"fixed", Boundary::fixed, "boundary vertices do not move"},
         {"slide", Boundary::slide,
          "boundary vertices move to the mean of their neighbours along the boundary; corners become round "
          "unless feature_angle keeps them"},
         {"free", Boundary::free, "boundary vertices move like all others, so an open surface shrinks"}},
        "How to handle boundary vertices, which are on an edge with exactly one face.");
    d.option("feature_angle", &RelaxOptions::feature_angle,
             "Keeps features. An edge is a feature if the normals of its two faces differ by more than this "
             "angle, or if it has three or more faces. Vertices on features move only along them. Vertices "
             "where feature lines end, meet or turn by more than this angle do not move. With slide, the "
             "boundary is such a line.")
        .between(0, 180);
    d.option("until", &RelaxOptions::until,
             "Stops when no vertex moves farther than this in an iteration, for example 0.01%. iterations is "
             "then the maximum, by default 1000. You get a warning if that was not enough, or if relaxation "
             "stopped early. The methods laplacian, cotangent and implicit would shrink a closed surface to "
             "a point, so they stop before a third of its area is lost.")
        .above(0);
    declare_caps(d, &RelaxOptions::caps);
    d.group("mask", &RelaxOptions::mask, mask_help, declare_mask);
}

} // namespace

void declare_relax(Declare<RelaxOptions>& d) {
    d.option("iterations", &RelaxOptions::iterations,
             "The number of iterations. Default: 1, or 1000 with until. 0 leaves the mesh unchanged.")
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
            add_refusal(Refusal{name, fmt::format("'{}' needs the method {}", name, to)}, "relax", given,
                        problems);
    };
    belongs("pass_band", Method::taubin, "taubin");
    belongs("alpha", Method::hc, "hc");
    belongs("beta", Method::hc, "hc");
    if (given.is_map() && given.find("neighbours") && settings.method == Method::cotangent)
        add_refusal(
            Refusal{
                "neighbours",
                "'neighbours' has no effect with the method cotangent, which weights neighbours by angles"},
            "relax", given, problems);
}

} // namespace facetmill::relax_stage
