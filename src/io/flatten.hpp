#pragma once
// For formats without nodes: the scene as meshes in world space.

#include "base/progress.hpp"
#include "io/codec.hpp"
#include "mesh/placement.hpp"

#include <set>

namespace facetmill::io {

/// The part's mesh in world space; a copy only when the part stands somewhere else (or elsewhere turned).
class WorldMesh {
  public:
    explicit WorldMesh(const Part& part);
    /// All parts joined in order, for formats that hold one mesh; primitives refer to the scene's materials.
    explicit WorldMesh(const Scene& scene);
    const Mesh& operator*() const { return given_ ? *given_ : own_; }
    const Mesh* operator->() const { return &**this; }

  private:
    const Mesh* given_ = nullptr;
    Mesh own_;
};

/// Throws stage (E-RANGE) when a position is beyond what float32 holds, or all are so small that none would
/// be left. what: "part 'cube'", "the scene".
void require_floats(const Mesh& mesh, const std::string& what);

/// What a format cannot hold: its attribute changes.
void dropped(Written& written, const Attribute& attribute, std::string why);

/// ... and what of glTF documents it leaves behind: textures and other properties of materials, skins,
/// animations (W-ANIMATION for these two), cameras, extensions. `format` is spelled as in "STL"; kept: what
/// it holds of these.
void leave_documents(Written& written, const Scene& scene, const char* format,
                     const std::set<std::string>& kept = {});

/// Warns (W-TEXTURES) of textured materials that the scene's faces have, by a format that could hold
/// textures.
void warn_of_textures(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of materials that the scene's faces have whose metalness, roughness or emission their
/// document states, by a format that holds colours only.
void warn_of_looks(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of materials with a colour that the scene's faces have, by a format without materials.
void warn_of_colours(Written& written, const Scene& scene, const char* format);

/// Warns (W-MATERIAL) of materials that points have, by a format that gives them none; lines, too.
void warn_of_point_materials(Written& written, const Scene& scene, const char* format, bool lines = true);

/// Warns (W-PARTS) that several parts become one mesh without their names, by a format that holds one.
void warn_of_parts(Written& written, const Scene& scene, const char* format);

/// Warns (W-NAME) of names of parts and materials with control characters, by a format that has none in
/// names.
void warn_of_names(Written& written, const Scene& scene, const char* format, bool materials = true);

/// Whether people may miss the attribute where a format has no place for it: not tangents and normals, which
/// follow from the rest, nor skins, which W-ANIMATION tells of, nor numbers of groups that a reader or a
/// stage made.
bool is_missed(const Attribute& attribute);
/// Warns (W-ATTRIBUTE) of attributes by these names, when there are any.
void warn_of_attributes(Written& written, const std::vector<std::string>& names, const char* format);

/// A name that fits on a line: control characters are blanks.
std::string one_line(std::string name);

/// Some of the names, and how many more there are.
std::string some_of(const std::vector<std::string>& names);

/// Numbers, text or bytes written chunk by chunk in parallel and joined in order.
/// write(begin, end, std::string& out) appends the text of items [begin, end).
template <class Write>
void append_text(Bytes& bytes, std::size_t n, Write&& write);

/// The shortest text that reads back as the same number, appended.
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
