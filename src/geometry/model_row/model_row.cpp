#include "geometry/model_row/model_row.hpp"

#include "base/math/portable_math.hpp"
#include "mesh/face.hpp"
#include "mesh/float32_ulp.hpp"
#include "mesh/power_scale.hpp"
#include "parallel/parallel.hpp"

#include <array>
#include <cmath>

namespace facetmill {

namespace {

/// The facts that the columns read.
struct ModelFacts {
    Properties properties;
    double height = 0, overhang_area = 0;
    std::uint64_t triangles = 0;
};

std::optional<double> requested(const ModelFacts& facts, std::string_view name) {
    const Property* property = property_named(name);
    return property ? property->get(facts.properties) : std::nullopt;
}

template <std::size_t axis, bool highest>
std::optional<double> bound(const ModelFacts& facts) {
    const Box& box = facts.properties.bounds;
    if (box.empty()) return {};
    return (highest ? box.max : box.min)[axis];
}

struct ColumnWithValue {
    ModelColumn column;
    std::optional<double> (*value)(const ModelFacts& facts);
};

using Kind = PropertyKind;

constexpr ColumnWithValue table[] = {
    {{"volume", "volume",
      "The volume of the solid. Space in several shells counts once. Null if a part is open.", Kind::volume},
     [](const ModelFacts& f) { return requested(f, "solid_volume"); }},
    {{"area", "area", "The area of the surface.", Kind::area},
     [](const ModelFacts& f) { return std::optional(f.properties.area); }},
    {{"bounds_min_x", "min x", "The lowest x of the bounding box."}, bound<0, false>},
    {{"bounds_min_y", "min y", "The lowest y of the bounding box."}, bound<1, false>},
    {{"bounds_min_z", "min z", "The lowest z of the bounding box."}, bound<2, false>},
    {{"bounds_max_x", "max x", "The highest x of the bounding box."}, bound<0, true>},
    {{"bounds_max_y", "max y", "The highest y of the bounding box."}, bound<1, true>},
    {{"bounds_max_z", "max z", "The highest z of the bounding box."}, bound<2, true>},
    {{"height", "height", "The extent of the bounding box along the up axis, which is z if it is unknown."},
     [](const ModelFacts& f) {
         return f.properties.bounds.empty() ? std::nullopt : std::optional(f.height);
     }},
    {{"wall_thickness", "smallest wall",
      "The smallest distance through the solid, as in validate. Null if there is no wall, or if a stage "
      "failed."},
     [](const ModelFacts& f) { return requested(f, "wall_thickness"); }},
    {{"overhang_area", "overhang",
      "The area of the faces that look down with a slope below the overhang angle, except where they lie on "
      "the plate.",
      Kind::area},
     [](const ModelFacts& f) { return std::optional(f.overhang_area); }},
    {{"parts", "parts", "The number of parts.", Kind::count},
     [](const ModelFacts& f) { return std::optional(static_cast<double>(f.properties.parts.value_or(1))); }},
    {{"components", "components", "The number of connected sets of faces.", Kind::count},
     [](const ModelFacts& f) { return std::optional(static_cast<double>(f.properties.components)); }},
    {{"triangles", "triangles", "The number of triangles after polygons are triangulated.", Kind::count},
     [](const ModelFacts& f) { return std::optional(static_cast<double>(f.triangles)); }},
};

constexpr auto columns_only = [] {
    std::array<ModelColumn, std::size(table)> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = table[i].column;
    return all;
}();

std::size_t up_axis(const Scene& scene) { return scene.up == UpAxis::y ? 1 : 2; }

std::uint64_t triangle_count_of(const Mesh& mesh) {
    std::uint64_t count = 0;
    for (Index f = 0; f < mesh.face_count(); ++f) {
        const auto corners = static_cast<std::uint64_t>(mesh.face_end(f) - mesh.face_begin(f));
        count += corners > 2 ? corners - 2 : 0;
    }
    return count;
}

/// The plate that a model lies on, and the slope below which faces overhang.
struct Plate {
    std::size_t axis = 2;
    double top = 0; ///< faces whose corners are all at most this high lie on the plate
    double tangent = 1;
};

/// A face overhangs if it looks down, and its horizontal component is below the tangent of its vertical one.
double overhang_of(const Part& part, const Plate& plate) {
    const Mesh& mesh = part.mesh;
    const bool mirrored = part.transform.determinant() < 0;
    return parallel_reduce(
        mesh.face_count(), 0.0,
        [&](std::size_t begin, std::size_t end) {
            double sum = 0;
            for (std::size_t i = begin; i < end; ++i) {
                const auto f = static_cast<Index>(i);
                Vec3 normal = area_vector(mesh, f, part.transform);
                if (mirrored) normal = -normal;
                const double down = -normal[plate.axis], area = safe_length(normal);
                if (!(down > 0)) continue;
                normal[plate.axis] = 0;
                if (!(safe_length(normal) < down * plate.tangent)) continue;
                bool lies = true;
                for (Index c = mesh.face_begin(f); c < mesh.face_end(f); ++c)
                    lies = lies && part.transform.point(mesh.point(c))[plate.axis] <= plate.top;
                if (!lies) sum += area / 2;
            }
            return sum;
        },
        [](double a, double b) { return a + b; });
}

ModelRow row_of(const Scene& scene, const ModelFacts& facts) {
    ModelRow row;
    row.unit = to_string(scene.unit);
    row.values.reserve(std::size(table));
    for (const auto& column : table) {
        auto value = column.value(facts);
        if (value && !std::isfinite(*value)) value.reset();
        row.values.push_back(value);
    }
    return row;
}

InspectSettings inspect_settings(const ModelRowSettings& settings) {
    InspectSettings inspect;
    for (const char* name : {"solid_volume", "wall_thickness"})
        if (const Property* property = property_named(name); property && (settings.walls || name[0] == 's'))
            inspect.request(*property);
    return inspect;
}

/// Sets the facts that are not properties, from the parts.
void add_parts(ModelFacts& facts, const Scene& scene, std::span<const Part> parts,
               const ModelRowSettings& settings) {
    const Box& box = facts.properties.bounds;
    if (box.empty()) return;
    Plate plate;
    plate.axis = up_axis(scene);
    plate.top = box.min[plate.axis] + float32_ulp(box); // files store the plate with this rounding
    plate.tangent = sine(settings.overhang_angle) / cosine(settings.overhang_angle);
    facts.height = box.max[plate.axis] - box.min[plate.axis];
    for (const Part& part : parts) {
        facts.overhang_area += overhang_of(part, plate);
        facts.triangles += triangle_count_of(part.mesh);
    }
}

} // namespace

std::span<const ModelColumn> model_columns() { return columns_only; }

ModelRow model_row(const Scene& scene, const ModelRowSettings& settings) {
    ModelFacts facts;
    facts.properties = inspect(scene, inspect_settings(settings));
    add_parts(facts, scene, scene.parts, settings);
    return row_of(scene, facts);
}

ModelRow model_row(const Scene& scene, const Part& part, const ModelRowSettings& settings) {
    ModelFacts facts;
    facts.properties = inspect(part, inspect_settings(settings));
    add_parts(facts, scene, {&part, 1}, settings);
    return row_of(scene, facts);
}

} // namespace facetmill
