#pragma once
// A document in less text.

#include "base/math/vec.hpp"
#include "io/gltf/document/json.hpp"

namespace facetmill::io::gltf {

/// Floating-point numbers that are whole become integers, and those of materials as few digits as float32
/// tells apart; members that say what is so without them go; matrices that only move and scale become a
/// translation and a scale. Numbers of nodes lose digits that move nothing by more than 1e-8 of the bounds'
/// diagonal. Extras stay as they are.
void shorten(Json& document, const Box& bounds);

/// Erases the names of nodes, meshes, images and what else only people look for, the asset's generator among
/// them; not those of scenes, animations, cameras and materials.
void drop_names(Json& document);

} // namespace facetmill::io::gltf
