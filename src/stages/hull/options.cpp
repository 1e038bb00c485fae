#include "stages/hull/options.hpp"

#include <fmt/format.h>

namespace facetmill::hull_stage {

namespace {

/// https://dev.epicgames.com/documentation/unreal-engine/fbx-static-mesh-pipeline-in-unreal-engine
const char* unreal_prefix(HullShape shape) {
    switch (shape) {
    case HullShape::box:
        return "UBX";
    case HullShape::sphere:
        return "USP";
    case HullShape::capsule:
        return "UCP";
    default:
        return "UCX";
    }
}

} // namespace

std::string collider_name(const HullOptions& o, const std::string& part, std::optional<std::size_t> number) {
    const std::string numbered = number ? fmt::format("{}_{:02}", part, *number) : part;
    switch (o.engine) {
    case Engine::unreal:
        return fmt::format("{}_{}_{:02}", unreal_prefix(o.shape), part, number.value_or(0));
    case Engine::godot:
        return numbered + "-convcolonly";
    case Engine::unity:
    case Engine::other:
        return number ? fmt::format("{}_collider_{:02}", part, *number) : part + "_collider";
    default:
        return numbered;
    }
}

void declare_hull(Declare<HullOptions>& d) {
    d.choice<HullShape>(
         "shape", &HullOptions::shape,
         {{"hull", HullShape::hull, "the convex hull"},
          {"box", HullShape::box, "an oriented box"},
          {"sphere", HullShape::sphere, "the smallest sphere, as a mesh around it"},
          {"capsule", HullShape::capsule, "a cylinder with round ends along the longest axis of the box"}},
         "The convex shape around the points.")
        .also_called("type primitive")
        .primary();
    d.choice<HullOptions::Per>("per", &HullOptions::per,
                               {{"part", HullOptions::Per::part, "each part gets its own shape"},
                                {"scene", HullOptions::Per::scene, "one shape around all parts"}},
                               "Which parts share a shape.");
    d.option("max_vertices", &HullOptions::max_vertices,
             "The largest number of vertices. A simpler hull replaces a hull with more vertices. Default: no "
             "limit.")
        .also_called("vertices max_verts maxNumVerticesPerCH")
        .between(12, 4096);
    d.option("max_parts", &HullOptions::max_parts,
             "The largest number of shapes per part. With more than 1, a concave part is divided first.")
        .also_called("parts max_hulls max_convex_hull maxhulls convex_parts")
        .between(1, 256);
    d.option("concavity", &HullOptions::concavity,
             "With max_parts: a hull whose points are all this close to the solid is not divided.")
        .also_called("threshold error max_concavity")
        .above(0);
    d.choice<Engine>(
        "engine", &HullOptions::engine,
        {{"none", Engine::none, "NAME, or NAME_00, NAME_01 ..."},
         {"unreal", Engine::unreal, "UCX_NAME_00, or UBX, USP and UCP for box, sphere and capsule"},
         {"godot", Engine::godot, "NAME-convcolonly: a convex collision shape that is not drawn"},
         {"unity", Engine::unity, "NAME_collider"},
         {"other", Engine::other, "NAME_collider"}},
        "The program that reads the names of the shapes.");
    d.option("keep", &HullOptions::keep, "Keeps the parts next to their shapes, instead of replacing them.");
}

} // namespace facetmill::hull_stage
