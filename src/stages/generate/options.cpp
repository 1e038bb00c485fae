#include "stages/generate/options.hpp"

#include "stage/options/convention.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct ShapeOptions {
    Shape shape;
    const char* name;
    std::vector<std::string> takes; ///< besides what all take
};

const std::vector<ShapeOptions>& shape_table() {
    static const std::vector<ShapeOptions> table = {
        {Shape::sphere, "sphere", {"radius", "faces", "around", "across"}},
        {Shape::icosphere, "icosphere", {"radius", "level"}},
        {Shape::cube, "cube", {"size", "cells"}},
        {Shape::grid, "grid", {"size", "cells"}},
        {Shape::torus, "torus", {"radius", "tube", "around", "across"}},
        {Shape::cylinder, "cylinder", {"radius", "height", "around", "across", "caps"}},
        {Shape::cone, "cone", {"radius", "height", "around", "across", "caps"}},
        {Shape::gaussian, "gaussian", {"size", "cells", "height", "spread"}},
        {Shape::menger, "menger", {"size", "level"}},
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
             "Of sphere, icosphere, cylinder and cone; of the circle that the torus' tube follows (a length; "
             "1 unless given).")
        .above(0);
    d.option("tube", &GenerateOptions::tube, "Radius of the torus' tube (a length; 0.4 radii unless given).")
        .above(0);
    d.option("size", &GenerateOptions::size,
             "Side of cube, grid, gaussian and menger (a length; 2 unless given).")
        .above(0);
    d.option(
         "height", &GenerateOptions::height,
         "Of cylinder and cone (a length; 2 radii unless given), or of the gaussian's peak (half its size "
         "unless given).")
        .above(0);
    d.option("spread", &GenerateOptions::spread,
             "Standard deviation of the gaussian (a length; 15% of its size unless given).")
        .above(0);
}

void declare_counts(Declare<GenerateOptions>& d) {
    d.option("faces", &GenerateOptions::faces,
             "Triangles of the sphere: the nearest number that bands allow whose faces at the equator are at "
             "most twice as wide as high, or as high as wide (a count; 4000 unless given, which is 80 around "
             "and 26 across).")
        .between(6, 700e6);
    d.option("around", &GenerateOptions::around,
             "Pieces around the axis of sphere, torus, cylinder and cone (a count; 48 unless given).")
        .between(3, 1e6);
    d.option(
         "across", &GenerateOptions::across,
         "Bands of the sphere from pole to pole, pieces around the torus' tube (24 unless given), rows of "
         "cylinder and cone (a count; 1 unless given).")
        .between(1, 1e6);
    d.option("cells", &GenerateOptions::cells,
             "Cells along each side of cube and grid (10 unless given) and of the gaussian (a count; 40 "
             "unless given).")
        .between(1, 20000);
    d.option("level", &GenerateOptions::level,
             "Of menger, 1 to 4 (2 unless given); how often the icosphere is refined, 0 to 12 (a count; 3 "
             "unless given).")
        .between(0, 12);
}

/// Counts whose least and most depend on the shape.
void verify_counts(const GenerateOptions& o, const Value& given, Problems& problems) {
    const auto at_least = [&](const char* name, const std::optional<std::int64_t>& count, std::int64_t least,
                              std::int64_t most) {
        if (count && given.find(name) && (*count < least || *count > most))
            problems.add(given.find(name)->mark, "E-RANGE",
                         fmt::format("'{}' of {} must be {} <= x <= {}, not {}", name, row_of(o.shape).name,
                                     least, most, *count));
    };
    if (o.shape == Shape::menger) at_least("level", o.level, 1, 4);
    if (o.shape == Shape::sphere) at_least("across", o.across, 2, 1000000);
    if (o.shape == Shape::torus) at_least("across", o.across, 3, 1000000);
}

/// A tube that fills the torus' hole, as far as both lengths can be compared before there is a scene.
void verify_torus(const GenerateOptions& o, const Value& given, Problems& problems) {
    const Value* tube = given.find("tube");
    if (o.shape != Shape::torus || !o.tube || !tube || tube->deferred) return;
    const Value* radius = given.find("radius");
    if (radius && radius->deferred) return;
    const Length middle = o.radius.value_or(Length::scene(1));
    if (middle.kind != o.tube->kind || middle.of != o.tube->of || o.tube->amount < middle.amount) return;
    problems.add(tube->mark, "E-RANGE",
                 fmt::format("generate: tube must be below the radius{}, not {}",
                             o.radius ? " " + o.radius->text : ", which is 1 unless given", o.tube->text),
                 "use a thinner tube or a larger radius");
}

} // namespace

const char* to_string(Shape shape) { return row_of(shape).name; }

void declare_generate(Declare<GenerateOptions>& d) {
    d.choice<Shape>(
         "shape", &GenerateOptions::shape,
         {{"sphere", Shape::sphere, "latitude and longitude: faces crowd at the poles, on the z axis"},
          {"icosphere", Shape::icosphere, "an icosahedron refined on the sphere: 20 * 4^level faces"},
          {"cube", Shape::cube, "a cube with gridded sides"},
          {"grid", Shape::grid, "a flat square, open"},
          {"torus", Shape::torus, "a ring around the z axis"},
          {"cylinder", Shape::cylinder, "along the z axis, with caps or open"},
          {"cone", Shape::cone, "along the z axis, apex up, with its base or open"},
          {"gaussian", Shape::gaussian, "the height field of a Gaussian over a square, open"},
          {"menger", Shape::menger, "the outer surface of a Menger sponge, closed"}},
         "What is made.")
        .primary()
        .required();
    declare_sizes(d);
    declare_counts(d);
    d.option("caps", &GenerateOptions::caps, "Close cylinder and cone.");
    d.option("quads", &GenerateOptions::quads, "Keep quads where the shape has them: no triangles of them.");
    d.option("noise", &GenerateOptions::noise,
             "Standard deviation of Gaussian noise on x, y and z of every vertex (a length; a percentage is "
             "of the shape's diagonal).")
        .at_least(0);
    d.option("seed", &GenerateOptions::seed, "Of the noise (an integer, without unit).").at_least(0);
    d.choice<Unit>("unit", &GenerateOptions::unit, unit_choices("auto", "the scene's"),
                   "What one unit of the shape's numbers is.");
    d.option("name", &GenerateOptions::name, "Of the new part; the shape's name unless given.");
}

void verify_generate(const GenerateOptions& o, const Value& given, Problems& problems) {
    if (!given.is_map()) return;
    const Value* shape = given.find("shape");
    if (shape && shape->deferred) return;
    const ShapeOptions& mine = row_of(o.shape);
    for (const auto& entry : given.entries) {
        std::string others;
        for (const auto& s : shape_table())
            if (takes(s, entry.key)) others += (others.empty() ? "" : ", ") + std::string(s.name);
        if (!others.empty() && !takes(mine, entry.key))
            problems.add(
                entry.key_mark, "E-CONFLICT",
                fmt::format("generate: '{}' goes with {}, not with {}", entry.key, others, mine.name),
                "leave it out");
    }
    verify_counts(o, given, problems);
    verify_torus(o, given, problems);
    if (o.faces && (o.around || o.across))
        problems.add(given.mark, "E-CONFLICT", "generate: 'faces' stands for 'around' and 'across'",
                     "give either faces, or around and across");
}

} // namespace facetmill
