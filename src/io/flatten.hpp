#pragma once
// Scenes as meshes in world space, for formats without nodes.

#include "base/progress.hpp"
#include "io/codec.hpp"
#include "mesh/placement.hpp"

#include <set>

namespace facetmill::io {

/// A hint for a scene of this size that is too large or too small for numbers: the scale to type.
[[nodiscard]] std::string hint_for_size(double size);

/// The part's mesh in world space; copied only if the transform is not the identity.
class WorldMesh {
  public:
    explicit WorldMesh(const Part& part);
    /// All parts joined in order, for formats with a single mesh. Primitives refer to the scene's materials.
    explicit WorldMesh(const Scene& scene);
    const Mesh& operator*() const { return given_ ? *given_ : own_; }
    const Mesh* operator->() const { return &**this; }

  private:
    const Mesh* given_ = nullptr;
    Mesh own_;
};

/// Throws a stage error (E-RANGE) if a position is beyond the range of float32, or if all positions are so
/// small that none would remain. what: for example "part 'cube'" or "the scene".
void require_floats(const Mesh& mesh, const std::string& what);

/// Records an attribute that the format cannot hold.
void dropped(Written& written, const Attribute& attribute, std::string why);

/// Records the losses of glTF documents: textures and other properties of materials, cameras, extensions,
/// skins and animations (W-ANIMATION for the last two), metadata and extras (W-LOST). `format` is spelled as
/// in "STL"; kept: the items that the format holds.
void leave_documents(Written& written, const Scene& scene, const char* format,
                     const std::set<std::string>& kept = {});

/// Warns (W-TEXTURES) of textured materials on faces, for a format that could hold textures.
void warn_of_textures(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of materials on faces with metalness, roughness or emission in their document, for a
/// format that holds only colours.
void warn_of_looks(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of coloured materials on faces, for a format without materials.
void warn_of_colours(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of materials on points, and on lines if `lines`, for a format that cannot hold these.
void warn_of_point_materials(Written& written, const Scene& scene, const char* format, bool lines = true);

/// Warns of materials, with the warnings above, and lists them as dropped, for a format without materials.
void drop_materials(Written& written, const Scene& scene, const char* format, bool points = true);

/// Warns (W-PARTS) that several parts are merged into a single mesh without names, for a format of a single
/// mesh.
void warn_of_parts(Written& written, const Scene& scene, const char* format);

/// Warns (W-NAME) of control characters in names of parts and materials, for a format that replaces them.
void warn_of_names(Written& written, const Scene& scene, const char* format, bool materials = true);

/// Whether people may miss the attribute if a format cannot hold it. Tangents and normals follow from other
/// data, W-ANIMATION covers skins, and readers or stages make group numbers, so none of these are missed.
bool is_missed(const Attribute& attribute);
/// Warns (W-ATTRIBUTE) of attributes by these names, if any.
void warn_of_attributes(Written& written, const std::vector<std::string>& names, const char* format,
                        const char* hint = "glTF keeps them: write .glb");
/// The same, for missed attributes that the list of changes has as dropped. uvs: also texture coordinates,
/// which are useless in a format without textures.
void warn_of_dropped(Written& written, const Scene& scene, const char* format, bool uvs = true);

/// A name that fits on a line: control characters become blanks.
[[nodiscard]] std::string one_line(std::string name);

/// Some of the names, and the number of others.
[[nodiscard]] std::string some_of(const std::vector<std::string>& names);

/// Writes numbers, text or bytes chunk by chunk in parallel and joins them in order. write(begin, end,
/// std::string& out) appends the text of items [begin, end).
template <class Write>
void append_text(Bytes& bytes, std::size_t n, Write&& write);

/// Appends the shortest text that reads back as the same number.
void put_number(std::string& out, double value);
void put_number(std::string& out, float value);
void put_number(std::string& out, std::int64_t value);

void append(Bytes& bytes, std::string_view text);

} // namespace facetmill::io

#include "parallel/parallel.hpp"

namespace facetmill::io {
template <class Write>
void append_text(Bytes& bytes, std::size_t n, Write&& write) {
    constexpr std::size_t chunk = 16384;
    std::vector<std::string> texts((n + chunk - 1) / chunk);
    ProgressScope::report_next_loop();
    parallel_chunks(
        n, [&](std::size_t begin, std::size_t end) { write(begin, end, texts[begin / chunk]); }, chunk);
    for (const auto& t : texts) append(bytes, t);
}
} // namespace facetmill::io
