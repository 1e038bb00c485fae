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
             "The radius of sphere, icosphere, cylinder and cone, and of the circle that the tube of the "
             "torus follows (a length; 1 unless given).")
        .above(0);
    d.option("minor_radius", &GenerateOptions::minor_radius,
             "The radius of the tube of the torus (a length; 0.4 times the radius unless given).")
        .above(0);
    d.option("size", &GenerateOptions::size,
             "The side of cube, grid, gaussian and menger (a length; 2 unless given).")
        .above(0);
    d.option("height", &GenerateOptions::height,
             "The height of cylinder and cone (a length; twice the radius unless given), or of the peak of "
             "the gaussian (half its size unless given).")
        .above(0);
    d.option("spread", &GenerateOptions::spread,
             "The standard deviation of the gaussian (a length; 15% of its size unless given).")
        .above(0);
}

void declare_counts(Declare<GenerateOptions>& d) {
    d.option("faces", &GenerateOptions::faces,
             "The number of triangles of the sphere: segments and rings are chosen to come nearest to it "
             "with faces at the equator that are at most twice as wide as high, or the reverse (a count; "
             "4000 unless given, which is 80 segments and 26 rings).")
        .also_called(property_named("faces")->also_called)
        .between(6, 700e6);
    d.option("segments", &GenerateOptions::segments,
             "Segments around the axis of sphere, torus, cylinder and cone (a count; 48 unless given).")
        .between(3, 1e6);
    d.option("rings", &GenerateOptions::rings,
             "Rings of faces of the sphere from pole to pole, or around the tube of the torus (24 unless "
             "given), or along cylinder and cone (a count; 1 unless given).")
        .between(1, 1e6);
    d.option("cells", &GenerateOptions::cells,
             "Cells along each side of cube and grid (10 unless given) and of the gaussian (a count; 40 "
             "unless given).")
        .between(1, 20000);
    d.option("subdivisions", &GenerateOptions::subdivisions,
             "The level of menger, 1 to 4 (2 unless given), or how often the icosphere is refined, 0 to 12 "
             "(a count; 3 unless given).")
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
                             o.radius ? " " + o.radius->text : ", which is 1 unless given",
                             o.minor_radius->text),
                 "use a smaller minor_radius or a larger radius");
}

} // namespace

const char* to_string(Shape shape) { return row_of(shape).name; }

void declare_generate(Declare<GenerateOptions>& d) {
    d.choice<Shape>(
         "shape", &GenerateOptions::shape,
         {{"sphere", Shape::sphere, "latitude and longitude: faces crowd at the poles, on the z axis"},
          {"icosphere", Shape::icosphere, "an icosahedron refined on the sphere: 20 * 4^subdivisions faces"},
          {"cube", Shape::cube, "a cube with gridded sides"},
          {"grid", Shape::grid, "a flat square, open"},
          {"torus", Shape::torus, "a ring around the z axis"},
          {"cylinder", Shape::cylinder, "along the z axis, with caps or open"},
          {"cone", Shape::cone, "along the z axis, apex up, with its base or open"},
          {"gaussian", Shape::gaussian, "the height field of a Gaussian over a square, open"},
          {"menger", Shape::menger, "the outer surface of a Menger sponge, closed"}},
         "The shape to generate.")
        .primary()
        .required();
    declare_sizes(d);
    declare_counts(d);
    d.option("caps", &GenerateOptions::caps, "Closes cylinder and cone with caps.");
    d.option("quads", &GenerateOptions::quads,
             "Keeps quads where the shape has them instead of cutting them into triangles.");
    d.option("noise", &GenerateOptions::noise,
             "The standard deviation of Gaussian noise on x, y and z of every vertex (a length; a percentage "
             "refers to the shape's diagonal).")
        .at_least(0);
    d.option("seed", &GenerateOptions::seed, "The seed of the noise (an integer, without unit).").at_least(0);
    d.choice<Unit>("unit", &GenerateOptions::unit, unit_choices("auto", "the scene's"),
                   "The unit of the shape's numbers.")
        .also_called(property_named("unit")->also_called);
    d.option("name", &GenerateOptions::name, "The name of the new part; the name of the shape unless given.");
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
                                fmt::format("'{}' goes with {}, not with {}", entry.key, others, mine.name),
                                "leave it out"},
                        "generate", given, problems);
    }
    verify_counts(o, given, problems);
    verify_torus(o, given, problems);
    if (o.faces && (o.segments || o.rings))
        add_refusal(Refusal{"faces", "'faces' stands for 'segments' and 'rings'",
                            "give either faces, or segments and rings"},
                    "generate", given, problems);
}

} // namespace facetmill::generate_stage
