#include "geometry/generate.hpp"

#include "base/error.hpp"
#include "io/convert.hpp"
#include "stage/convention_option.hpp"
#include "stage/stage.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace facetmill {

namespace {

struct GenerateOptions {
    Shape shape = Shape::sphere;
    std::optional<Length> radius, tube, size, height, spread;
    std::optional<std::int64_t> faces, around, across, cells, level;
    bool caps = true;
    bool quads = false;
    Length noise = Length::scene(0);
    std::int64_t seed = 0;
    Unit unit = Unit::unknown;
    std::string name;
};

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

void declare(Declare<GenerateOptions>& d) {
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

void verify(const GenerateOptions& o, const Value& given, Problems& problems) {
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
                entry.key_mark, "E-EXCLUSIVE",
                fmt::format("generate: '{}' goes with {}, not with {}", entry.key, others, mine.name),
                "leave it out");
    }
    verify_counts(o, given, problems);
    verify_torus(o, given, problems);
    if (o.faces && (o.around || o.across))
        problems.add(given.mark, "E-EXCLUSIVE", "generate: 'faces' stands for 'around' and 'across'",
                     "give either faces, or around and across");
}

/// What is being made, in its own unit.
struct Made {
    Scene scene;
    double of_entering = 1; ///< that unit's share of the entering scene's, which percentages are of
};

Made made_for(const Scene& entering, Unit unit) {
    Made made;
    made.scene.unit = unit == Unit::unknown ? entering.unit : unit;
    made.scene.up = UpAxis::z;
    const double from = metres(entering.unit), to = metres(made.scene.unit);
    if (from > 0 && to > 0) made.of_entering = from / to;
    return made;
}

/// The length in the unit of the shape. Refuses a percentage of nothing.
double resolved_length(const Length& length, const Made& made, const char* name, Context& context) {
    const double x = context.resolve(length, made.scene, name) *
                     (length.kind == Length::Kind::percent ? made.of_entering : 1);
    if (length.kind == Length::Kind::percent && length.amount > 0 && x == 0)
        throw Error(ErrorKind::usage, "E-RANGE",
                    fmt::format("generate: '{}' is {}, but {}", name, length.text,
                                length.of == Length::Of::load ? "nothing has been loaded yet"
                                                              : "the scene is empty yet"),
                    "give a number, or a length with a unit");
    return x;
}

/// The options as numbers; lengths in the unit of the scene that they are read for.
GenerateSettings resolved(const GenerateOptions& o, const Made& made, Context& context) {
    GenerateSettings s;
    s.shape = o.shape;
    const auto set = [&](double& out, const std::optional<Length>& length, const char* name,
                         double otherwise) {
        out = length ? resolved_length(*length, made, name, context) : otherwise;
    };
    set(s.radius, o.radius, "radius", 1);
    set(s.size, o.size, "size", 2);
    set(s.tube, o.tube, "tube", 0.4 * s.radius);
    set(s.height, o.height, "height", o.shape == Shape::gaussian ? s.size / 2 : 2 * s.radius);
    set(s.spread, o.spread, "spread", 0.15 * s.size);
    const bool rows = o.shape == Shape::cylinder || o.shape == Shape::cone;
    s.around = o.around.value_or(48);
    s.across = o.across.value_or(rows ? 1 : 24);
    if (o.shape == Shape::sphere && !o.around && !o.across) {
        const SphereBands bands = sphere_bands(o.faces.value_or(4000));
        s.around = bands.around, s.across = bands.across;
    }
    s.cells = o.cells.value_or(o.shape == Shape::gaussian ? 40 : 10);
    s.level = o.level.value_or(o.shape == Shape::menger ? 2 : 3);
    s.caps = o.caps, s.quads = o.quads;
    return s;
}

/// A percentage of noise is of the shape itself: the scene that enters may be empty.
double noise_of(const GenerateOptions& o, const Made& made, const Part& part, Context& context) {
    if (o.noise.kind != Length::Kind::percent || o.noise.of == Length::Of::load)
        return resolved_length(o.noise, made, "noise", context);
    Length of_shape = o.noise;
    of_shape.of = Length::Of::part;
    return context.resolve(of_shape, made.scene, "noise", &part);
}

Scene run(Scene scene, const GenerateOptions& o, Context& context) {
    Made made = made_for(scene, o.unit);
    Part& part = made.scene.parts.emplace_back();
    part.name = o.name.empty() ? row_of(o.shape).name : o.name;
    part.changed = true;
    part.mesh = generate(resolved(o, made, context));
    const double noise = noise_of(o, made, part, context);
    part.mesh = with_noise(std::move(part.mesh), noise, static_cast<std::uint64_t>(o.seed));
    const Json result = {{"shape", row_of(o.shape).name},
                         {"vertices", part.mesh.vertex_count()},
                         {"faces", part.mesh.face_count()}};
    io::add_scene(scene, std::move(made.scene));
    context.result() = result;
    context.result()["part"] = scene.parts.back().name;
    context.run().load_diagonal = scene.bounds().diagonal();
    return scene;
}

const RegisterStage registered = make_stage<GenerateOptions>(
    {.name = "generate",
     .about = "Makes a shape from numbers and adds it to the scene: spheres, cube, torus, Menger sponge ...",
     .details =
         "The shape becomes a new part. It is centred on the origin with its axis along z (grid and gaussian "
         "stand on z = 0), and all its faces are seen anticlockwise from outside. Sphere, icosphere, cube, "
         "torus, menger, and cylinder and cone with caps are closed and manifold; grid and gaussian are "
         "open. "
         "In a scene that has parts already, the shape is converted to the scene's unit and up axis.\n\n"
         "Faces are triangles, quads cut along their shorter diagonal, or quads on request. Noise moves each "
         "vertex by independent normal amounts along x, y and z, cut off at three standard deviations; it "
         "depends on the seed and the vertex's place alone. Each option goes with the shapes that its help "
         "names and is refused with others. A shape that does not fit into memory is refused before it is "
         "built (E-MEMORY).",
     .examples = {"generate: sphere", "generate: {shape: menger, level: 3, quads: true}",
                  "generate: {shape: gaussian, cells: 60, noise: 0.3%, seed: 4}",
                  "generate: {shape: cylinder, radius: 5mm, height: 20mm, unit: mm}"},
     .loads = true},
    declare, run, StageHooks<GenerateOptions>{.files = {}, .verify = verify});

} // namespace

} // namespace facetmill
