#include "stages/generate/options.hpp"

#include "base/text/words.hpp"
#include "geometry/inspect/inspect.hpp"
#include "options/mark_at.hpp"
#include "stage/options/convention.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill::generate_stage {

namespace {

struct ShapeOptions {
    Shape shape;
    const char* name;
    std::vector<std::string>
        takes; ///< options that this shape takes, in addition to the options of all shapes
};

const std::vector<ShapeOptions>& shape_table() {
    static const std::vector<ShapeOptions> table = {
        {Shape::sphere, "sphere", {"radius", "faces", "segments", "rings"}},
        {Shape::icosphere, "icosphere", {"radius", "subdivisions"}},
        {Shape::cube, "cube", {"size", "cells"}},
        {Shape::grid, "grid", {"size", "cells"}},
        {Shape::torus, "torus", {"radius", "minor_radius", "segments", "rings"}},
        {Shape::cylinder, "cylinder", {"radius", "height", "segments", "rings", "caps"}},
        {Shape::cone, "cone", {"radius", "height", "segments", "rings", "caps"}},
        {Shape::gaussian, "gaussian", {"size", "cells", "height", "spread"}},
        {Shape::menger, "menger", {"size", "subdivisions"}},
    };
    return table;
}

const ShapeOptions& row_of(Shape shape) {
    return *std::find_if(shape_table().begin(), shape_table().end(),
                         [&](const ShapeOptions& s) { return s.shape == shape; });
}

bool takes(const ShapeOptions& shape, const std::string& option) {
    return std::find(shape.takes.begin(), shape.takes.end(), option) != shape.takes.end();
}

void declare_sizes(Declare<GenerateOptions>& d) {
    d.option("radius", &GenerateOptions::radius,
             "The radius of sphere, icosphere, cylinder and cone, or of the circle at the centre of the "
             "torus tube. Default: 1.")
        .above(0);
    d.option("minor_radius", &GenerateOptions::minor_radius,
             "The radius of the torus tube. Default: 0.4 times the radius.")
        .above(0);
    d.option("size", &GenerateOptions::size, "The side of cube, grid, gaussian and menger. Default: 2.")
        .above(0);
    d.option("height", &GenerateOptions::height,
             "The height of cylinder and cone (default: twice the radius), or of the gaussian's peak "
             "(default: half its size).")
        .above(0);
    d.option("spread", &GenerateOptions::spread,
             "The standard deviation of the gaussian. Default: 15% of its size.")
        .above(0);
}

void declare_counts(Declare<GenerateOptions>& d) {
    d.option(
         "faces", &GenerateOptions::faces,
         "The approximate number of triangles of the sphere. Segments and rings are chosen so that faces at "
         "the equator have sides in a ratio of at most 2. Default: 4000, with 80 segments and 26 rings.")
        .also_called(property_named("faces")->also_called)
        .between(6, 700e6);
    d.option("segments", &GenerateOptions::segments,
             "Segments around the axis of sphere, torus, cylinder and cone. Default: 48.")
        .between(3, 1e6);
    d.option("rings", &GenerateOptions::rings,
             "Rings of faces from pole to pole of the sphere or around the torus tube (default: 24), or "
             "along cylinder and cone (default: 1).")
        .between(1, 1e6);
    d.option("cells", &GenerateOptions::cells,
             "Cells along each side of cube and grid (default: 10) and of the gaussian (default: 40).")
        .between(1, 20000);
    d.option("subdivisions", &GenerateOptions::subdivisions,
             "The level of menger, from 1 to 4 (default: 2), or the number of refinements of the icosphere, "
             "from 0 to 12 (default: 3).")
        .between(0, 12);
}

/// Checks counts whose limits depend on the shape.
void verify_counts(const GenerateOptions& o, const Value& given, Problems& problems) {
    const auto at_least = [&](const char* name, const std::optional<std::int64_t>& count, std::int64_t least,
                              std::int64_t most) {
        if (count && given.find(name) && (*count < least || *count > most))
            problems.add(given.find(name)->mark, "E-RANGE",
                         fmt::format("'{}' of {} must be {} <= x <= {}, not {}", name, row_of(o.shape).name,
                                     least, most, *count));
    };
    if (o.shape == Shape::menger) at_least("subdivisions", o.subdivisions, 1, 4);
    if (o.shape == Shape::sphere) at_least("rings", o.rings, 2, 1000000);
    if (o.shape == Shape::torus) at_least("rings", o.rings, 3, 1000000);
}

/// Refuses a tube that fills the torus' hole, if both lengths are comparable without a scene.
void verify_torus(const GenerateOptions& o, const Value& given, Problems& problems) {
    const Value* minor = given.find("minor_radius");
    if (o.shape != Shape::torus || !o.minor_radius || !minor || minor->deferred) return;
    const Value* radius = given.find("radius");
    if (radius && radius->deferred) return;
    const Length middle = o.radius.value_or(Length::scene(1));
    if (middle.kind != o.minor_radius->kind || middle.of != o.minor_radius->of ||
        o.minor_radius->amount < middle.amount)
        return;
    problems.add(minor->mark, "E-RANGE",
                 fmt::format("generate: minor_radius must be below the radius{}, not {}",
                             o.radius ? " " + o.radius->text : ", which defaults to 1", o.minor_radius->text),
                 "use a smaller minor_radius or a larger radius");
}

} // namespace

const char* to_string(Shape shape) { return row_of(shape).name; }

void declare_generate(Declare<GenerateOptions>& d) {
    d.choice<Shape>("shape", &GenerateOptions::shape,
                    {{"sphere", Shape::sphere,
                      "rings and segments along latitude and longitude; faces are smaller near the poles, on "
                      "the z axis"},
                     {"icosphere", Shape::icosphere, "a refined icosahedron with 20 * 4^subdivisions faces"},
                     {"cube", Shape::cube, "a cube whose sides are grids"},
                     {"grid", Shape::grid, "a flat, open square"},
                     {"torus", Shape::torus, "a ring around the z axis"},
                     {"cylinder", Shape::cylinder, "a cylinder along the z axis, with caps or open"},
                     {"cone", Shape::cone, "a cone along the z axis with its apex up, with its base or open"},
                     {"gaussian", Shape::gaussian, "the height field of a Gaussian over a square, open"},
                     {"menger", Shape::menger, "the outer surface of a Menger sponge, closed"}},
                    "The shape to generate.")
        .primary()
        .required();
    declare_sizes(d);
    declare_counts(d);
    d.option("caps", &GenerateOptions::caps, "Closes cylinder and cone with caps.");
    d.option("quads", &GenerateOptions::quads, "Keeps quads instead of cutting them into triangles.");
    d.option("noise", &GenerateOptions::noise,
             "The standard deviation of Gaussian noise on x, y and z of every vertex. A percentage refers to "
             "the shape's diagonal.")
        .at_least(0);
    d.option("seed", &GenerateOptions::seed, "The seed of the noise.").at_least(0);
    d.choice<Unit>("unit", &GenerateOptions::unit, unit_choices("auto", "the unit of the scene"),
                   "The unit of the shape's numbers.")
        .also_called(property_named("unit")->also_called);
    d.option("name", &GenerateOptions::name, "The name of the new part. Default: the name of the shape.");
}

void verify_generate(const GenerateOptions& o, const Value& given, Problems& problems) {
    if (!given.is_map()) return;
    const Value* shape = given.find("shape");
    if (shape && shape->deferred) return;
    const ShapeOptions& mine = row_of(o.shape);
    for (const auto& entry : given.entries) {
        std::string others;
        for (const auto& s : shape_table())
            if (takes(s, entry.key)) append_item(others, s.name);
        if (!others.empty() && !takes(mine, entry.key))
            add_refusal(Refusal{entry.key,
                                fmt::format("'{}' applies to {}, not to {}", entry.key, others, mine.name),
                                "remove it"},
                        "generate", given, problems);
    }
    verify_counts(o, given, problems);
    verify_torus(o, given, problems);
    if (o.faces && (o.segments || o.rings))
        add_refusal(Refusal{"faces", "'faces' replaces 'segments' and 'rings'",
                            "give either faces, or segments and rings"},
                    "generate", given, problems);
}

} // namespace facetmill::generate_stage
