#pragma once
// The options of generate and their conversion to settings.

#include "geometry/generate/generate.hpp"
#include "stage/stage.hpp"

namespace facetmill::generate_stage {

struct GenerateOptions {
    Shape shape = Shape::sphere;
    std::optional<Length> radius, minor_radius, size, height, spread;
    std::optional<std::int64_t> faces, segments, rings, cells, subdivisions;
    bool caps = true;
    bool quads = false;
    Length noise = Length::scene(0);
    std::int64_t seed = 0;
    Unit unit = Unit::unknown;
    std::string name;
};

/// The shape's name in pipelines.
[[nodiscard]] const char* to_string(Shape shape);

void declare_generate(Declare<GenerateOptions>& d);
/// Checks options of other shapes, and counts whose limits depend on the shape. The declaration cannot
/// express these.
void verify_generate(const GenerateOptions& o, const Value& given, Problems& problems);

} // namespace facetmill::generate_stage
