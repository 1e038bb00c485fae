#pragma once
// The materials of an OBJ file: its .mtl libraries, and their conversion to glTF.

#include "io/images/pixels.hpp"
#include "io/material_document.hpp"
#include "io/obj/obj.hpp"

#include <array>
#include <optional>

namespace facetmill::io::obj {

/// A texture statement: an image and its mapping. Its v starts at the bottom.
struct Map {
    std::string file;                 ///< as written in the file
    std::filesystem::path relative{}; ///< the path relative to the OBJ file; empty if the path is absolute
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    bool clamp = false;
    double strength = 1; ///< the bump multiplier, -bm

    bool operator==(const Map&) const = default; ///< also compares the strength
    /// Whether both have the same mapping.
    bool lies_as(const Map& other) const {
        return scale == other.scale && offset == other.offset && clamp == other.clamp;
    }
};

using Colour = std::array<double, 3>;

/// A material as in the library. Statements missing from the file are empty.
struct Description {
    std::optional<std::string> name{};                 ///< the name in a comment, if newmtl has another name
    std::optional<Colour> diffuse, specular, emission; ///< Kd, Ks, Ke
    std::optional<double> shininess, roughness, metalness; ///< Ns, Pr, Pm
    std::optional<int> illumination;                       ///< illum
    double opacity = 1;                                    ///< d, or 1 - Tr
    bool double_sided = false;         ///< read from a comment, because MTL has no statement for it
    std::map<std::string, Map> maps;   ///< by keyword: "map_Kd" is "kd"
    std::vector<std::string> left_out; ///< statements and options that glTF cannot represent

    bool operator==(const Description&) const = default;
};

/// The names in a mtllib statement. A name may have blanks, so the whole text is a name if that file exists;
/// otherwise each name ends with ".mtl".
[[nodiscard]] std::vector<std::string> library_names(const Input& input, const std::string& text);

/// The materials of all libraries that the events name, by name. A library that cannot be read is a warning
/// (W-MTL), because the mesh is complete without it.
[[nodiscard]] std::map<std::string, Description>
read_libraries(const Input& input, const std::vector<Event>& events, ReadLog& log);

/// Makes the scene's materials and their document from descriptions.
class MaterialMaker {
  public:
    /// names_only: only images() is needed, so derived images are not computed.
    MaterialMaker(const Input& input, std::map<std::string, Description> descriptions, ReadLog& log,
                  bool names_only = false);
    /// The index in `materials` of the material with this name. textured: the faces have texture
    /// coordinates. Warns of statements that glTF cannot represent (W-MTL) and of unreadable textures
    /// (W-IMAGE).
    Index index_of(const std::string& name, bool textured, std::vector<Material>& materials);
    /// The images of the materials so far.
    std::vector<NamedImage> images() const { return document_.images(); }
    /// Adds the document to the scene if it is not empty.
    void finish(Scene& scene);

  private:
    struct Image {
        Bytes bytes;
        std::optional<Pixels> pixels; ///< decoded on demand
    };
    Image* image_of(const std::string& material, const std::string& word, const Map& map);
    const Pixels* pixels_of(const std::string& material, const std::string& word, const Map& map);
    Json reference(const std::filesystem::path& image, const Bytes& bytes, const Map& map,
                   bool is_file = false);
    std::optional<Json> texture(const std::string& material, const std::string& word, const Map& map);
    std::optional<Json> surface_texture(const std::string& name, const Description& d);
    Json material_json(const std::string& name, const Description& d, bool textured);
    void add_colour_maps(Json& json, const std::string& name, const Description& d);
    void add_opacity_map(Json& json, const std::string& name, const Description& d);
    void add_surface_maps(Json& json, const std::string& name, const Description& d);
    void add_relief_map(Json& json, const std::string& name, const Description& d);
    void warn(const std::string& material, std::string message);
    /// The result of `make`, an image made of these maps; `how` names the operation.
    template <class Make>
    Bytes made(const char* how, const Map* first, const Map* second, Make&& make);

    const Input& input_;
    std::map<std::string, Description> descriptions_;
    ReadLog& log_;
    const bool names_only_;
    MaterialDocument document_;
    std::map<std::filesystem::path, std::optional<Image>> images_;
    std::map<std::pair<std::string, bool>, Index> known_;
};

/// The comment (after #) for a material that is visible from both sides.
inline constexpr std::string_view double_sided_comment = "doubleSided: true";
/// The comment (after #) for a name that newmtl cannot hold, or that several materials have.
inline constexpr std::string_view name_comment = "glTF name:";

/// The roughness of a highlight with Phong's exponent (Ns).
[[nodiscard]] double roughness_of(double exponent);

/// The .mtl text of materials: their usemtl names and descriptions.
[[nodiscard]] std::string material_library(const std::vector<std::pair<std::string, Description>>& materials);

} // namespace facetmill::io::obj
