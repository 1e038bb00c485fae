#pragma once
// The materials of an OBJ file: its .mtl libraries, and what their words mean in glTF.

#include "io/images/pixels.hpp"
#include "io/material_document.hpp"
#include "io/obj/obj.hpp"

#include <array>
#include <optional>

namespace facetmill::io::obj {

/// A texture statement: an image, and how it is laid on. Texture points count from the bottom.
struct Map {
    std::string file;                 ///< as spelled
    std::filesystem::path relative{}; ///< to the OBJ file; empty when it is absolute
    std::array<double, 2> scale{1, 1}, offset{0, 0};
    bool clamp = false;
    double strength = 1; ///< -bm

    bool operator==(const Map&) const = default; ///< also the same strength
    /// Whether the image of another statement lies where this one's does.
    bool lies_as(const Map& other) const {
        return scale == other.scale && offset == other.offset && clamp == other.clamp;
    }
};

using Colour = std::array<double, 3>;

/// A material as a library has it. Words that are not in the file are none.
struct Description {
    std::optional<std::string> name{};                     ///< as a comment, where newmtl has another
    std::optional<Colour> diffuse, specular, emission;     ///< Kd, Ks, Ke
    std::optional<double> shininess, roughness, metalness; ///< Ns, Pr, Pm
    std::optional<int> illumination;                       ///< illum
    double opacity = 1;                                    ///< d, or 1 - Tr
    bool double_sided = false;                             ///< as a comment: MTL has no word for it
    std::map<std::string, Map> maps;                       ///< by their word, "map_Kd" as "kd"
    std::vector<std::string> left_out;                     ///< words and options that glTF cannot represent

    bool operator==(const Description&) const = default;
};

/// The materials of all libraries that the events name, by name. What cannot be read is a warning (W-MTL):
/// the mesh is whole without it.
std::map<std::string, Description> read_libraries(const Input& input, const std::vector<Event>& events,
                                                  ReadLog& log);

/// Makes materials of a scene from descriptions, and the document that tells them.
class MaterialMaker {
  public:
    /// names_only: for images(), without the work of making images of others.
    MaterialMaker(const Input& input, std::map<std::string, Description> descriptions, ReadLog& log,
                  bool names_only = false);
    /// The index in the materials of the one with that name; textured: for faces with texture points. What
    /// glTF cannot say is a warning (W-MTL), as are textures that cannot be read (W-IMAGE).
    Index index_of(const std::string& name, bool textured, std::vector<Material>& materials);
    /// The images of the materials so far.
    std::vector<NamedImage> images() const { return document_.images(); }
    /// Gives the scene the document, when there is anything in it.
    void finish(Scene& scene);

  private:
    struct Image {
        Bytes bytes;
        std::optional<Pixels> pixels; ///< once they were asked for
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
    /// What make gives, an image made of these in the way that how names.
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

/// What facetmill writes and reads behind # for a material whose both sides are seen.
inline constexpr std::string_view double_sided_comment = "doubleSided: true";
/// ... and before a name that newmtl does not spell, or that another material has, too.
inline constexpr std::string_view name_comment = "glTF name:";

/// The roughness of a highlight with Phong's exponent (Ns).
double roughness_of(double exponent);

/// The .mtl file of materials: their names, which are those of an OBJ, and what they are.
std::string material_library(const std::vector<std::pair<std::string, Description>>& materials);

} // namespace facetmill::io::obj
