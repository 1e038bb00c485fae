#include "base/error.hpp"
#include "io/convert.hpp"
#include "mesh/power_scale.hpp"
#include "stages/generate/help.hpp"
#include "stages/generate/options.hpp"

#include <fmt/format.h>

namespace facetmill::generate_stage {

namespace {

/// The generated scene in its own unit.
struct Made {
    Scene scene;
    double of_entering = 1; ///< converts lengths from the input scene's unit, which percentages use
};

Made made_for(const Scene& entering, Unit unit) {
    Made made;
    made.scene.unit = unit == Unit::unknown ? entering.unit : unit;
    made.scene.up = UpAxis::z;
    const double from = metres(entering.unit), to = metres(made.scene.unit);
    if (from > 0 && to > 0) made.of_entering = from / to;
    return made;
}

/// The length in the unit of the shape. Refuses a percentage without a scene to refer to.
double resolved_length(const Length& length, const Made& made, const char* name, Context& context) {
    const double x = context.resolve(length, made.scene, name) *
                     (length.kind == Length::Kind::percent ? made.of_entering : 1);
    if (length.kind == Length::Kind::percent && length.amount > 0 && x == 0)
        throw Error(ErrorKind::usage, "E-RANGE",
                    fmt::format("generate: '{}' is {}, but {}", name, length.text,
                                length.of == Length::Of::load ? "nothing has been loaded yet"
                                                              : "the scene is still empty"),
                    "give a number, or a length with a unit");
    return x;
}

/// The options as numbers; lengths are in the unit of the scene.
GenerateSettings resolved(const GenerateOptions& o, const Made& made, Context& context) {
    GenerateSettings s;
    s.shape = o.shape;
    const auto set = [&](double& out, const std::optional<Length>& length, const char* name,
                         double otherwise) {
        out = length ? resolved_length(*length, made, name, context) : otherwise;
    };
    set(s.radius, o.radius, "radius", 1);
    set(s.size, o.size, "size", 2);
    set(s.minor_radius, o.minor_radius, "minor_radius", 0.4 * s.radius);
    set(s.height, o.height, "height", o.shape == Shape::gaussian ? s.size / 2 : 2 * s.radius);
    set(s.spread, o.spread, "spread", 0.15 * s.size);
    const bool rows = o.shape == Shape::cylinder || o.shape == Shape::cone;
    s.segments = o.segments.value_or(48);
    s.rings = o.rings.value_or(rows ? 1 : 24);
    if (o.shape == Shape::sphere && !o.segments && !o.rings) {
        const SphereBands bands = sphere_bands(o.faces.value_or(4000));
        s.segments = bands.segments;
        s.rings = bands.rings;
    }
    s.cells = o.cells.value_or(o.shape == Shape::gaussian ? 40 : 10);
    s.subdivisions = o.subdivisions.value_or(o.shape == Shape::menger ? 2 : 3);
    s.caps = o.caps;
    s.quads = o.quads;
    return s;
}

/// A percentage of noise refers to the shape itself, because the input scene may be empty.
double noise_of(const GenerateOptions& o, const Made& made, const Part& part, Context& context) {
    if (o.noise.kind != Length::Kind::percent || o.noise.of == Length::Of::load)
        return resolved_length(o.noise, made, "noise", context);
    Length of_shape = o.noise;
    of_shape.of = Length::Of::part;
    return context.resolve(of_shape, made.scene, "noise", &part);
}

struct GenerateReport {
    std::string shape;
    std::size_t vertices = 0, faces = 0;
    std::string part;
};

void declare_report(DeclareFields<GenerateReport>& d) {
    d.field("shape", &GenerateReport::shape, "The name of the shape.");
    d.field("vertices", &GenerateReport::vertices, "The number of vertices.");
    d.field("faces", &GenerateReport::faces, "The number of faces.");
    d.field("part", &GenerateReport::part, "The name of the part.");
}

Scene run(Scene scene, const GenerateOptions& o, Context& context, GenerateReport& report) {
    Made made = made_for(scene, o.unit);
    Part& part = made.scene.parts.emplace_back();
    part.name = o.name.empty() ? to_string(o.shape) : o.name;
    part.changed = true;
    part.mesh = generate(resolved(o, made, context));
    const double noise = noise_of(o, made, part, context);
    part.mesh = with_noise(std::move(part.mesh), noise, static_cast<std::uint64_t>(o.seed));
    report = {to_string(o.shape), part.mesh.vertex_count(), part.mesh.face_count(), {}};
    io::add_scene(scene, std::move(made.scene));
    report.part = scene.parts.back().name;
    return scene;
}

struct GenerateStage : StageOf<run> {
    void verify(const Value& given, Problems& problems) const override {
        verify_generate(o, given, problems);
    }
};

const RegisterStage registered = make_stage<GenerateStage>(
    {.name = "generate",
     .also_called = "create primitive sphere cube",
     .about = help::generate::about,
     .details = help::generate::details,
     .examples = {"generate: sphere", "generate: {shape: menger, subdivisions: 3, quads: true}",
                  "generate: {shape: gaussian, cells: 60, noise: 0.3%, seed: 4}",
                  "generate: {shape: cylinder, radius: 5mm, height: 20mm, unit: mm}"},
     .loads = true,
     .roles = {.sets_unit = "unit"}},
    declare_generate, declare_report);

} // namespace

} // namespace facetmill::generate_stage
