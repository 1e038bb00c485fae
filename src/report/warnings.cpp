#include "report/warnings.hpp"

namespace facetmill::report {

const std::vector<KnownWarning>& known_warnings() {
    static const std::vector<KnownWarning> all{
        {"W-AMPLITUDE", "crumple moves vertices further than the edges are long: faces run into each other."},
        {"W-ATTRIBUTE", "An attribute of a type that meshes cannot have is not read."},
        {"W-CAP-OPEN", "clip cannot close a contour that is open; it is named, and the others are capped."},
        {"W-CHECK", "An assertion with severity warn does not hold."},
        {"W-CLEAN", "clean could not do some repairs; the mesh is as it was there."},
        {"W-CLIP-ALL", "The planes of clip do not meet the mesh: all of it is kept."},
        {"W-CLIP-NOTHING", "The planes of clip leave nothing."},
        {"W-CROP-ALL", "The outline of crop does not meet the mesh: all of it is kept."},
        {"W-CROP-NOTHING", "The outline of crop leaves nothing."},
        {"W-EXTENSION", "A glTF extension is dropped, because what it spoke of has changed or is not known."},
        {"W-FACES", "Faces that are none (fewer than three corners, or the same vertex twice) are skipped."},
        {"W-FANS", "triangulate cut faces that intersect themselves, or have no area, as fans."},
        {"W-FORMAT", "A file is of another format than its name says."},
        {"W-GROUPS", "The names of an OBJ's groups are not kept."},
        {"W-IMAGE", "An image or texture that the file names is not read or not kept."},
        {"W-INCOMPLETE", "Indices are left over after the last triangle of a glTF primitive."},
        {"W-INDEX", "Corners name texture points or normals that the OBJ does not have."},
        {"W-INSIDE-OUT", "The faces of a solid look inward, so its volume is negative."},
        {"W-INSTANCES", "Instances of a glTF mesh differ now, so they get meshes of their own."},
        {"W-MANIFOLD", "EXT_mesh_manifold cannot be read or written for a part."},
        {"W-MERGED", "Of several glTF documents only meshes and materials go into one file."},
        {"W-MESHOPT", "EXT_meshopt_compression is not written: the data is stored plain."},
        {"W-MTL", "A material library of an OBJ is missing, elsewhere, or has statements that are not kept."},
        {"W-NAN", "Values of an attribute are not finite numbers and are set to 0."},
        {"W-NODES", "A glTF node has two parents and stands under the first."},
        {"W-ONLY", "`only`, or a foreach over parts, selects no part."},
        {"W-OPEN-SECTION", "A section has open contours, because the mesh is open where the plane cuts it."},
        {"W-ORIENT", "A part is not orientable and stays as it was."},
        {"W-ORIENT-OPEN", "The outside of an open part is not clear."},
        {"W-PROBE-OPEN", "The surface is open, so nothing is inside or outside of it."},
        {"W-ROUNDED", "A written file, read again, is less sound than the scene: rounding merged points."},
        {"W-SECTION-CROSSES",
         "Contours of a section intersect themselves: no centroid and moments for them."},
        {"W-SIMPLIFY-NOTHING", "simplify has nothing to do: the target is not below the mesh."},
        {"W-SIMPLIFY-STOPPED", "simplify stopped before its target, because of borders, topology or flips."},
        {"W-SKIN", "A skinned part is moved in bind pose and loses its skin."},
        {"W-SKIPPED", "Something in a file that a mesh cannot hold is skipped."},
        {"W-SPLIT-FOLDED", "split laid pieces of concave faces over each other; they are counted."},
        {"W-SPLIT-NOTHING", "split has nothing to do: there are as many faces as the target allows."},
        {"W-SPLIT-SHARED", "Faces that share two edges got new edges with more than two faces."},
        {"W-SPLIT-STOPPED", "split stopped before max_edge was reached, because of passes or faces."},
        {"W-THICKEN", "The faces of a thickened part intersect."},
        {"W-THICKEN-THIN", "A thickened wall is thinner somewhere than asked for."},
        {"W-TILE-NOTHING", "A part without faces gives no tile."},
        {"W-TRAILING", "Bytes behind the last triangle of an STL are skipped."},
        {"W-TRANSFORM", "A glTF node keeps its transform although its part has moved."},
        {"W-UNITS", "A scene without a unit meets one that has a unit: numbers are taken as they are."},
        {"W-UNORIENTED", "Neighbouring faces disagree, so outlines and holes are told by nesting."},
    };
    return all;
}

} // namespace facetmill::report
