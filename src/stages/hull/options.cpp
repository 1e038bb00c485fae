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

std::string collider_name(const HullOptions& o, const std::string& part) {
    switch (o.engine) {
    case Engine::unreal:
        return fmt::format("{}_{}_00", unreal_prefix(o.shape), part);
    case Engine::godot:
        return part + "-convcolonly";
    case Engine::unity:
    case Engine::other:
        return part + "_collider";
    default:
        return part;
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
    d.choice<Engine>(
        "engine", &HullOptions::engine,
        {{"none", Engine::none, "NAME"},
         {"unreal", Engine::unreal, "UCX_NAME_00, or UBX, USP and UCP for box, sphere and capsule"},
         {"godot", Engine::godot, "NAME-convcolonly: a convex collision shape that is not drawn"},
         {"unity", Engine::unity, "NAME_collider"},
         {"other", Engine::other, "NAME_collider"}},
        "The program that reads the names of the shapes.");
    d.option("keep", &HullOptions::keep, "Keeps the parts next to their shapes, instead of replacing them.");
}

} // namespace facetmill::hull_stage
