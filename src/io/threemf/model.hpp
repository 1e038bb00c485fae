#pragma once
// The contents of the model parts of a 3MF archive before conversion to a scene. Private to threemf.

#include "io/threemf/xml.hpp"
#include "mesh/scene.hpp"

#include <array>
#include <map>
#include <set>

namespace facetmill::io::threemf {

inline constexpr std::string_view core_space = "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr std::string_view material_space =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
inline constexpr std::string_view production_space =
    "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";
inline constexpr std::string_view lattice_space =
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/2017/02";
/// The extensions that a file may require.
inline constexpr std::string_view known_spaces[] = {
    core_space,
    material_space,
    production_space,
    lattice_space,
    "http://schemas.microsoft.com/3dmanufacturing/beamlattice/balls/2020/07",
    "http://schemas.microsoft.com/3dmanufacturing/slice/2015/07"};

/// The names of units in 3MF.
struct UnitName {
    const char* name;
    Unit unit;
};
inline constexpr UnitName unit_names[] = {{"micron", Unit::um},     {"millimeter", Unit::mm},
                                          {"centimeter", Unit::cm}, {"inch", Unit::inch},
                                          {"foot", Unit::foot},     {"meter", Unit::m}};

using Colour = std::array<std::uint8_t, 4>; ///< sRGB and alpha

/// The source of a triangle's properties: a group of resources and three indices into it.
struct Properties {
    std::uint32_t group = none; ///< none: uses the object's properties
    std::array<std::uint32_t, 3> index{none, none, none};
};

struct ObjectId {
    std::string path; ///< the path of the model part: "/3D/3dmodel.model"
    std::uint32_t id = 0;
    auto operator<=>(const ObjectId&) const = default;
};

struct Use { ///< a component, or a build item
    ObjectId object;
    Transform transform;
    bool printed = true; ///< false for items that PrusaSlicer and its kin show, but do not print
    std::size_t line = 0;
};

struct Object {
    std::string name, part_number;
    std::string type; ///< "model", "solidsupport", "support", "surface" or "other"
    Properties properties;
    std::vector<Vec3> positions;
    std::vector<Index> corners;
    std::vector<Index> beams;          ///< two ends each
    std::vector<Properties> triangles; ///< [triangles]; empty: all have the object's properties
    std::vector<Use> components;
};

struct TextureImageFile {
    std::string path; ///< of the image in the archive
    bool clamp = false;
};

struct Group {
    bool materials = false;         ///< true for named materials, false for colours and textures
    std::vector<std::string> names; ///< names of materials
    std::vector<Colour> colours;    ///< of layers with a texture: multiplied by it
    std::uint32_t texture = none;
    std::vector<std::array<float, 2>> points; ///< of the texture, with v from the bottom

    bool textured() const { return texture != none; }
    std::size_t size() const { return textured() ? points.size() : colours.size(); }
};

/// One XML part of the archive.
struct Model {
    Unit unit = Unit::mm;
    bool has_build = false;
    std::map<std::uint32_t, Object> objects;
    std::map<std::uint32_t, Group> groups;
    std::map<std::uint32_t, TextureImageFile> textures;
    std::vector<Use> items;
    std::map<std::string, std::size_t> skipped;                ///< unsupported elements and their counts
    std::vector<std::pair<std::string, std::string>> metadata; ///< names and texts, except of programs
    std::vector<std::string> faults; ///< broken rules of the specification, for warnings
};

/// The names of metadata that all programs know, except those about the file itself.
inline constexpr std::string_view metadata_names[] = {"Title",        "Designer", "Description", "Copyright",
                                                      "LicenseTerms", "Rating",   "CreationDate"};
/// The member of a primitive's extras with the part number of its object.
inline constexpr const char* part_number_key = "partnumber";

/// path: of the part in the archive. Throws as read_xml, E-EXTENSION for an unsupported required extension,
/// limit (E-SIZE) beyond max_vertices.
[[nodiscard]] Model read_model(Span xml, const std::string& archive, const std::string& path,
                               std::size_t max_vertices);

/// The unit of the model part; reads only its first element. Throws the errors of read_model.
[[nodiscard]] Unit unit_of_model(Span xml, const std::string& archive, const std::string& path);

} // namespace facetmill::io::threemf
