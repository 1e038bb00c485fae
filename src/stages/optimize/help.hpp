#pragma once
// The help and manual texts of optimize.

namespace facetmill::help::optimize {

inline constexpr const char* about =
    R"(Makes a scene cheaper to load and to draw, without a change of what is seen.)";

inline constexpr const char* details =
    R"(dedup makes one of images of equal bytes, equal samplers, textures and materials, meshes that are
equal to the bit, vertices of one place with equal attributes, and accessors of equal bytes. join
makes one part of those that share their materials and have the same attributes, in the place of the
first of them, and one primitive of those of one material. prune erases materials, textures,
samplers, images, meshes and accessors that nothing uses, the least and greatest numbers of
accessors that glTF does not ask for, tracks of animations that keep a node where it is without them
(within 1e-6 of the scene's diagonal, 1e-5 of a scale or a quaternion), and the nodes that join,
flatten and instance have emptied, with the groups above them that have nothing else.

On request: drop_attributes drops texture coordinates that no texture reads, tangents without a map
of normals, normals of unlit materials, what morph targets displace of them, and colours that are
white throughout (not beside extensions of a primitive), and merges vertices that only these kept
apart. drop_own does the same to attributes that glTF does not know, whose names begin with _ there.
palette makes one material of those that are nothing but plain colours, metalness, roughness and
emission, with a pixel of 8 bits a channel for each, for parts without texture coordinates; parts of
different colours can be joined then. flatten moves nodes to the top of the scene. instance makes
one node, with a list of places, of parts that share a mesh and are not mirrored; later stages see
its mesh once, so it comes last. `load: {instances: expand}` is its reverse.

Parts stay by themselves, where they are, that are skinned, animated or joints, are not in the
scene that viewers show, have morph targets, a camera, extras or extensions (also of their mesh or of a node above them), or, for join, share
their mesh with another part (unless join_shared, or the same meshes stand together at each of their
places: then they become one mesh, which stays shared); so do those that `only` leaves out.

Names are lost with what was joined or made one; keep_names keeps apart what has different names.
Nothing is erased from a document with an extension whose references are not known, and nothing in
it is joined, moved or painted.)";

} // namespace facetmill::help::optimize
