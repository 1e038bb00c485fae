#pragma once
// The files of a glTF: the GLB container (a header of 12 bytes, a JSON chunk and perhaps a binary one, each
// padded to 4 bytes), and the buffers and images that a document names by URI. The directory rule holds for
// all of them (io/images/image_files.hpp); they are named by relative URIs.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/json.hpp"

#include <optional>

namespace facetmill::io::gltf {

/// What to do with glTF of before 2017.
inline constexpr const char* hint_for_version_1 = "gltf-pipeline writes glTF 1.0 as 2.0";

/// What body gives; its errors are placed in the file.
template <class Body>
auto in_file(const Input& input, Body&& body) {
    try {
        return body();
    } catch (Error& e) {
        throw e.at(file_mark(input.name()));
    } catch (const Json::exception& e) {
        throw Error(ErrorKind::malformed, "E-GLTF", e.what(), "", file_mark(input.name()));
    }
}

/// True when the bytes begin with the GLB magic number.
bool is_glb(Span bytes);

/// The chunks of a container, pointing into it.
struct Chunks {
    std::string_view json;
    std::optional<Span> binary;
};
/// Throws malformed (E-GLB) with the byte offset of what is wrong. Chunks of unknown kinds are skipped.
Chunks split_glb(Span bytes);
/// The container of a document and its buffer (none when empty). Throws limit (E-SIZE) beyond 4 GiB, which
/// the header cannot say.
Bytes join_glb(std::string_view json, Span binary);

/// True for "data:..." URIs.
bool is_data_uri(std::string_view uri);
/// The bytes of a data URI in base64; characters of other kinds are passed over.
Bytes data_uri_bytes(std::string_view uri);
/// The path that a relative URI names, percent-decoded and normalised; none when it is absolute or remote.
std::optional<std::filesystem::path> decoded_path(std::string_view uri);
/// The file of a buffer. Throws malformed (E-URI) when it is absolute, remote, or breaks the directory rule.
std::filesystem::path buffer_path(const JsonCursor& buffer, const std::string& uri, const Input& input);

/// The files that the entries of "buffers" or "images" name, relative to the document, each once; the
/// directory rule is not asked.
std::vector<std::filesystem::path> neighbours(const Json& document, const char* list);
/// Reads all buffers of the document. Buffer 0 without a URI is the binary chunk; buffers that exist only for
/// readers without meshopt decoding stay empty. Throws malformed (E-URI for a URI that breaks the directory
/// rule, E-BUFFER for too few bytes), missing (E-FILE).
std::vector<Bytes> load_buffers(const Json& document, std::optional<Span> binary_chunk, const Input& input,
                                ReadLog& log);

/// Reads the images beside the file, by their URI as spelled. What cannot be read is a warning (W-IMAGE):
/// nothing here looks into images, so a missing one only fails to come along.
std::map<std::string, Bytes> load_images(const Json& document, const Input& input, ReadLog& log);
/// Drops the files that no image of the document names any more.
void drop_unnamed_files(std::map<std::string, Bytes>& files, const Json& document);

} // namespace facetmill::io::gltf
