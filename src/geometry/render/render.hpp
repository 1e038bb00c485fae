#pragma once
// Renders a scene: each face is shaded by the angle between its normal and the light, after P. Bourke,
// "Facets, planes, normals, rendering" (1992), with the textures of its material.

#include "geometry/render/colour_range.hpp"
#include "geometry/render/texture.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <functional>
#include <optional>

namespace facetmill {

/// The direction of view. Up is the scene's up axis. If it is undefined, up is y or z: the axis with a flat
/// base, otherwise the longer axis. The front is towards +z if y points up (glTF), and towards -y if z does.
/// An open surface in a scene without an up axis is seen from the side of its normals.
enum class Viewpoint {
    corner, ///< from the front, slightly from above and from the right
    front,
    back,
    left,
    right,
    top,
    bottom,
};

enum class Shading {
    sides,     ///< both sides are lit; the inner side is orange unless the material is double-sided, so that
               ///< holes and reversed faces are visible
    one_sided, ///< max(0, n . l) with the normal by the corner order: reversed faces are dark
    absolute,  ///< |n . l|: both sides are shaded alike
};

enum class ShadingNormals {
    automatic, ///< the mesh's own normals if present, otherwise face normals
    flat,      ///< a normal per face
    smooth,    ///< the mesh's own normals if present, otherwise smooth normals with edges at 40 degrees
};

/// The source of the colours of faces.
enum class Paint {
    material, ///< the base colour of the material times its texture and the colours of the mesh, as in glTF
    part,     ///< a colour for each part
    normal,   ///< the direction of the face, x y z as red green blue
    plain,    ///< grey
};

enum class EdgeLines { few, all, no }; ///< few: only in scenes of at most PictureSettings::few faces

/// The camera of a picture, to view another scene in the same way, in parallel projection.
struct Camera {
    Vec3 up, front;
    Box seen; ///< box of the scene along the right, up and viewing directions of the picture
};

struct PictureSettings {
    int width = 480, height = 360; ///< pixels, 1 to 8192
    Viewpoint viewpoint = Viewpoint::corner;
    std::optional<Vec3> from; ///< the direction towards the viewer, in world space, instead of viewpoint
    double turn = 0;          ///< radians that the viewer moves around the up axis, anticlockwise from above
    std::optional<Camera> camera; ///< camera of another scene with the same direction; not with perspective
    double perspective = 0;       ///< the angle of view over the scene, radians, below pi; 0: parallel
    double zoom = 1;              ///< at least 1; the middle of the picture is magnified
    double max_scale = HUGE_VAL;  ///< pixels per unit before zoom, for pictures with a common scale
    std::optional<Vec3> at;       ///< the world point at the centre, if zoom is not 1
    Shading shading = Shading::sides;
    ShadingNormals normals = ShadingNormals::automatic;
    bool occlusion = true; ///< corners and folds are darker
    bool coarse_occlusion =
        false; ///< computes occlusion only at every second pixel of every second row, in a third of the time
    bool silhouettes = false; ///< lines where the depth jumps
    Paint paint = Paint::material;
    std::string attribute; ///< if a mesh has this attribute, its first component replaces paint: identifiers
                           ///< (Role::index) in distinct colours, numbers on a scale
    ColourRange range{};   ///< range of the scale
    bool legend = false;   ///< draw the scale with its numbers to the right of the scene, if it fits
    std::string unit{};    ///< after the name of the attribute in the legend
    EdgeLines edges = EdgeLines::few;
    std::size_t few = 6000;
    double point =
        1; ///< in pixels: the side of the square for a vertex without faces, and the width of lines
    std::optional<std::array<float, 3>> ground{}; ///< linear background; none: transparent
    std::function<bool(const Part&)> shows{};     ///< selects parts; empty: all
    std::vector<Vec3> marks{};                    ///< world positions to mark with rings, drawn on top
    std::shared_ptr<const ResolvedMaterials>
        materials{}; ///< materials with textures; empty: only Material::base_colour
};

/// Rows from the top, four bytes a pixel: red, green, blue (sRGB), alpha (0 for empty pixels).
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    double scale = 0;           ///< pixels per scene unit at the centre; 0 for a scene without extent
    std::size_t faces = 0;      ///< number of faces of the visible parts
    ValueRange range{};         ///< range of the attribute's numbers
    bool has_attribute = false; ///< true if a part has the attribute
};

/// Draws the scene in world space, fitted into 92 % of the picture.
/// - Parts without faces show their vertices and lines. Points that are not finite are left out. An empty
///   scene gives an empty picture.
/// - Polygons are drawn as triangulated() cuts them, with their own edges only.
/// - Each pixel has four samples of the visible surface, and a shade for each face among them.
/// - Materials that blend are composited by depth, the sixteen nearest at each sample.
/// - Occlusion is estimated from the depths around each pixel (M. McGuire, M. Mara, D. Luebke, "Scalable
///   Ambient Obscurance", 2012).
///
/// The result is the same for any number of threads and any processor. Memory: 64 bytes a pixel, 24 a
/// vertex, the layers (Layers), and 4 bytes for each blending triangle and band of 16 pixel rows. Throws a
/// limit error (E-MEMORY) if memory is short.
[[nodiscard]] Picture picture_of(const Scene& scene, const PictureSettings& settings = {});

/// The camera of picture_of, which shows the whole scene; empty for an empty scene. With settings.camera,
/// uses its direction. O(vertices).
[[nodiscard]] Camera camera_of(const Scene& scene, const PictureSettings& settings = {});

/// The value of Picture::scale before zoom, without rendering. Accounts for the legend.
[[nodiscard]] double fitting_scale(const Scene& scene, const PictureSettings& settings);

/// The position of most of a scene, if it is hardly visible because a few elements are far away.
struct Crowd {
    Vec3 middle;       ///< in world space
    double pixels = 0; ///< the size of most of the scene in the picture
    double zoom = 1;   ///< the zoom that would show it around the middle
};

/// Describes the crowd: "most of the scene is 3 pixels wide in the picture, because something lies far off".
[[nodiscard]] std::string crowd_in_words(const Crowd& crowd);

/// The box around the drawn vertices, without the outer tenth at either end of each axis. None unless it
/// covers less than a hundredth of the picture's longer side before zoom. Samples every n-th vertex if there
/// are many. O(n).
[[nodiscard]] std::optional<Crowd> crowd_of(const Scene& scene, const PictureSettings& settings);

/// Arranges pictures of the same size in this many columns. Unused cells of the last row are transparent.
[[nodiscard]] Picture sheet_of(const std::vector<Picture>& pictures, std::size_t columns);

} // namespace facetmill
