#pragma once
// The files of a glTF: the GLB container (a 12-byte header, a JSON chunk and an optional binary chunk, each
// padded to 4 bytes), and separate buffers and images. Relative URIs name these files, and the directory
// rule applies to all of them (io/images/image_files.hpp).

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/json.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// The hint for glTF 1.0 files.
inline constexpr const char* hint_for_version_1 =
    "convert it to glTF 2.0: npx gltf-pipeline -i old.gltf -o new.gltf";

/// The message for a member that no check has covered.
inline constexpr const char* wrong_type = "a member does not have the type that glTF requires";

/// Calls body, and adds the file to its errors.
template <class Body>
[[nodiscard]] auto in_file(const Input& input, Body&& body) {
    try {
        return body();
    } catch (Error& e) {
        throw e.at(file_mark(input.name()));
    } catch (const Json::exception&) {
        throw Error(ErrorKind::malformed, "E-GLTF", wrong_type, "", file_mark(input.name()));
    }
}

/// True when the bytes begin with the GLB magic number.
bool is_glb(Span bytes);

/// Whether a JSON text is a tileset of 3D Tiles. Tilesets and glTF both have an "asset", so the first member
/// that only one of both formats has decides.
bool is_tileset(std::string_view json);

/// The chunks of a container, pointing into it.
struct Chunks {
    std::string_view json;
    std::optional<Span> binary;
    std::size_t skipped = 0; ///< bytes of unknown chunks, and after the last chunk
};
/// Throws a malformed-input error (E-GLB) with the byte offset of the error. Skips unknown chunks.
[[nodiscard]] Chunks split_glb(Span bytes);
/// The container of a document and its buffer (none when empty). Throws a limit error (E-SIZE) beyond 4 GiB,
/// the maximum of the header's size field.
[[nodiscard]] Bytes join_glb(std::string_view json, Span binary);

/// True for "data:..." URIs.
bool is_data_uri(std::string_view uri);
/// The bytes of a base64 data URI; skips characters outside the alphabet.
[[nodiscard]] Bytes data_uri_bytes(std::string_view uri);
/// The percent-decoded, normalised path of a relative URI; none for absolute or remote URIs.
[[nodiscard]] std::optional<std::filesystem::path> decoded_path(std::string_view uri);
/// The file of a buffer. Throws a malformed-input error (E-URI) when it is absolute, remote, or breaks the
/// directory rule.
[[nodiscard]] std::filesystem::path buffer_path(const JsonCursor& buffer, const std::string& uri,
                                                const Input& input);

/// The files that "buffers" or "images" name, relative to the document, each once. Does not apply the
/// directory rule.
[[nodiscard]] std::vector<std::filesystem::path> neighbours(const Json& document, const char* list);
/// Reads all buffers of the document. Buffer 0 without a URI is the binary chunk; buffers that exist only
/// for readers without meshopt decoding stay empty. Throws a malformed-input error (E-URI for a URI that
/// breaks the directory rule, E-BUFFER for too few bytes) and a missing-file error (E-FILE).
[[nodiscard]] std::vector<Bytes> load_buffers(const Json& document, std::optional<Span> binary_chunk,
                                              const Input& input, ReadLog& log);

/// Reads the image files of the document, keyed by their URI as written. Unreadable images give a warning
/// (W-IMAGE): nothing here decodes images, so a missing file is only not copied.
[[nodiscard]] std::map<std::string, Bytes> load_images(const Json& document, const Input& input,
                                                       ReadLog& log);
/// Drops the files that no image of the document uses.
void drop_unnamed_files(std::map<std::string, Bytes>& files, const Json& document);

} // namespace facetmill::io::gltf
