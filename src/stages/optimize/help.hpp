#pragma once
// The help and manual texts of optimize.

namespace facetmill::help::optimize {

inline constexpr const char* about = R"(Makes a scene faster to load and to draw without a visible change.)";

inline constexpr const char* details =
    R"(The option dedup merges duplicates.
These are images and accessors with equal bytes, equal samplers, textures and materials, exactly
equal meshes, and vertices with equal positions and attributes.

The option join merges parts that share a material and have the same attributes.
It also merges primitives with the same material.

The option prune removes unused materials, textures, samplers, images, meshes and accessors.
It removes accessor bounds that glTF does not require.
It also removes animation tracks that do not move a node (within 1e-6 of the scene's diagonal, or
1e-5 for scales and quaternions). Other tracks that stay the same get a single key.
Finally, it removes nodes that join, flatten and instance emptied, and groups that become empty.

Other steps must be requested.
The option max_motion drops animation keys that interpolation gives anyway, and stores constant tracks
as a single key.
The ratio is of the diagonal of the document's meshes.
It is divided among all animated properties that move a vertex, so their errors together stay
below it.
Rotations also stay within 0.1 degrees, and scales within 0.001.
Cubic tracks, and nodes above cameras or lights, keep their keys.
The option resample replaces linear keys by keys at a fixed rate, which may cut off fast motions.
The option drop_attributes removes texture coordinates without a texture, tangents without a normal
map, normals of unlit materials, and their morph target data.
It also removes colours that are entirely white, unless the primitive has extensions.
It then merges vertices that differed only in these attributes.
The option drop_own does the same for attributes unknown to glTF, whose names begin with _.

The option palette replaces plain materials by one material, for parts without texture coordinates.
Each original material becomes a pixel with 8 bits per channel.
A plain material has only colour, metalness, roughness and emission.
Parts of different colours can then be joined.

The option flatten moves nodes to the top of the scene.
The option instance replaces parts that share a mesh, and are not mirrored, by one node with a list
of positions.
Later stages see this mesh once, so use instance last.
The reverse of instance is `load: {instances: expand}`.

Some parts stay separate and unchanged.
These parts are skinned, animated or joints, are outside the scene that viewers show, or have morph
targets, a camera, extras or extensions.
Extras and extensions of their mesh or parent nodes count as well.
Parts that `only` excludes also stay unchanged.
The option join leaves out parts that share their mesh with others, unless join_shared is on.
If the same meshes appear together at several positions, join merges them into one shared mesh.

Merged items lose their names.
The option keep_names prevents merging items with different names.
A document with an extension whose references are unknown is not changed: nothing is removed,
joined, moved or painted.)";

} // namespace facetmill::help::optimize
