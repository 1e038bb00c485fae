#pragma once
// A picture of a scene, for people who would rather look: orthographic, each face shaded by the angle between
// its normal and the light, after P. Bourke, "Facets, planes, normals, rendering" (1992).

#include "mesh/scene.hpp"

#include <array>
#include <functional>
#include <optional>

namespace facetmill {

/// Where a picture is taken from. Up is the scene's, or else the longer one of y and z; the front is towards
/// +z where y points up (glTF), and towards -y where z does.
enum class Viewpoint {
    corner, ///< from the front, somewhat from above and from the right
    front,
    back,
    left,
    right,
    top,
    bottom,
};

enum class Shading {
    sides,     ///< both sides are lit; the inner one is orange unless the material is double-sided, so that
               ///< holes and turned faces are seen
    one_sided, ///< max(0, n . l) with the normal of the face's own order: turned faces are dark
    absolute,  ///< |n . l|: the back is shaded as the front is
};

/// What faces are painted with.
enum class Paint {
    material, ///< the base colour of the material times the colours of the mesh, as in glTF; textures are
              ///< not looked at
    part,     ///< a colour for each part
    normal,   ///< the direction of the face, x y z as red green blue
    plain,    ///< grey
};

enum class EdgeLines { few, all, no }; ///< few: of parts in scenes of at most PictureSettings::few faces

struct PictureSettings {
    int width = 480, height = 360; ///< pixels, 1 to 8192
    Viewpoint viewpoint = Viewpoint::corner;
    std::optional<Vec3> from; ///< the direction towards the viewer, in world space, instead of viewpoint
    Shading shading = Shading::sides;
    Paint paint = Paint::material;
    std::string attribute; ///< instead of paint, where a mesh has it: its first component, identifiers
                           ///< (Role::index) in colours of their own, numbers from blue to yellow
    EdgeLines edges = EdgeLines::few;
    std::size_t few = 6000;
    double point = 1;                             ///< pixels, a side of the square of a vertex without faces
    std::optional<std::array<float, 3>> ground{}; ///< linear background; none: transparent
    std::function<bool(const Part&)> shows{};     ///< which parts; empty: all
};

/// Rows from the top, four bytes a pixel: red, green, blue (sRGB), alpha (0 where nothing is).
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgba;
    double scale = 0;                  ///< pixels per unit of the scene; 0 when it has no extent
    std::size_t faces = 0;             ///< drawn, that is of parts that it shows
    std::array<double, 2> range{0, 0}; ///< of the numbers that the attribute has, blue and yellow
    bool has_attribute = false;        ///< some part has it
};

/// The scene in world space, as large as fits into 92 % of the picture. Parts without faces show their
/// vertices. Points that are not finite are left out, and an empty scene gives an empty picture. Polygons are
/// drawn as triangulated() cuts them, their own edges only. Each pixel has four samples. The same bytes for
/// any number of threads. Memory: 64 bytes a pixel, and 24 a vertex of one part.
Picture picture_of(const Scene& scene, const PictureSettings& settings = {});

/// Both beside each other, of one height.
Picture beside(const Picture& left, const Picture& right);

} // namespace facetmill
