#pragma once
// What the help and the manual say about optimize.

namespace facetmill::help::optimize {

inline constexpr const char* about =
    R"(Makes a scene cheaper to load and to draw, without a change of what is seen.)";

inline constexpr const char* details =
    R"(dedup makes one of images of equal bytes, equal samplers, textures and materials, and meshes that
are equal to the bit. join makes one part of those that share their materials and have the same
attributes, in the place of the first of them, and one primitive of those of one material. Parts
stay by themselves that are skinned, animated or joints, have morph targets, a camera, extras or
extensions (also of their mesh or of a node above them), or share their mesh with another part
(unless join_shared); so do those that `only` leaves out. prune erases materials, textures,
samplers, images, meshes and accessors that nothing uses, and the nodes that join has emptied, with
the groups above them that have nothing else.

Names are lost with what was joined; keep_names keeps apart what has different names. Nothing is
erased from a document with an extension whose references are not known, and nothing in it is
joined. Instancing (EXT_mesh_gpu_instancing) is left as it is.)";

} // namespace facetmill::help::optimize
