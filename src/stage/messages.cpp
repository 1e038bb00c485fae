#include "base/message_ids.hpp"

namespace facetmill {

const RegisterMessages stage_messages{
    {"E-BOX", "A box has no extent, or one of its corners is missing.",
     "Give `min` and `max`, or `centre` and `size`. `max` must be greater than `min` along all three axes.",
     ErrorKind::usage},
    {"E-REFERENCE", "The mesh file that a stage takes values from has no faces.",
     "Set `with` to a mesh file that has faces.", ErrorKind::stage},
    {"W-BIND-POSE",
     "Stages work on the bind pose of a skinned part. Viewers and pictures show the pose of the joints, so a "
     "plane or box can cut a different place than you see.",
     "Give positions in the bind pose. `facetmill info` prints its bounds."},
    {"W-CAP-OPEN", "`clip` cannot cap an open contour. It reports the contour and caps the others.",
     "Close the holes that the plane cuts through with `clean`."},
    {"W-CONVENTION",
     "Two scenes that are compared have the same bounding box in another unit, or after a rotation of the "
     "axes. A picture then shows one of them as a dot, or lying on its side.",
     "Give `--unit` and `--up` to `facetmill render` and `facetmill diff`, as the hint of the warning shows. "
     "In "
     "a pipeline, use `load: {unit: mm, up: z}`, or `transform` before the stage."},
    {"W-FANS",
     "Faces were replaced by triangles that may overlap. The faces have no area, or they are non-planar and "
     "intersect themselves. Or a face with neighbours winds around some points several times.",
     "Check the faces given in the message."},
    {"W-LINES",
     "A file has no lines for tubes, tubes intersect themselves at sharp corners, or a format cannot store "
     "lines. Or a stage works on faces and leaves parts of lines unchanged.",
     "For tubes, give a smaller thickness, or use `clean: {self_intersections: union}`. Write lines as PLY, "
     "OBJ or glTF. `load: {lines: 1%}` turns lines into tubes, which are faces."},
    {"W-MASK", "A mask selects no vertex, so nothing moves.", "Check the attribute and its range."},
    {"W-POINTS",
     "A stage that works on faces leaves point clouds unchanged. A point cloud is a part without faces and "
     "lines.",
     "Leave clouds out with the common key `only`, as in `only: \"!points\"`. `crop`, `clip`, `tile`, "
     "`transform` and `merge` work on points."},
    {"W-REST-POSE",
     "A limit of the deviation, such as `max_error`, holds for the rest pose of a skinned or morphed part. "
     "The deviation is larger if joints bend the surface or morph targets move it. `simplify` measures it in "
     "sampled poses.",
     "Use `simplify` with a ratio for parts that move, as in `simplify: 50%`, and look at the result in "
     "several poses."},
    {"W-SNAPPED",
     "`clip` or `crop` treats vertices near the plane or the outline as on it. The part is so far from the "
     "origin that its 32-bit floats are rounded visibly, by up to a quarter of a metre in UTM.",
     "Use `snap: 0` to keep positions exact, if they were never 32-bit floats."},
    {"W-SURFACE-LOST",
     "A stage removed all faces of a part, or more of its area than expected. The limit is a tenth, or half "
     "for stages that change the shape: `relax`, `split`, `simplify`, and `clean` with `self_intersections: "
     "union`. Stages that cut, scale or replace the surface on request may remove any area.",
     "Validate the input of the stage, because folded, flat or doubled surfaces cancel each other. "
     "`--strict=W-SURFACE-LOST` makes it an error."},
};

} // namespace facetmill
