#pragma once
// Reads accessors of a glTF document as typed arrays. The document is untrusted: every range is checked
// against the available bytes. Memory out of proportion to the bytes is refused.

#include "io/bytes.hpp"
#include "io/codec.hpp"
#include "io/gltf/document/json.hpp"
#include "mesh/mesh.hpp"

#include <map>

namespace facetmill::io::gltf {

/// glTF's names for number types.
enum ComponentType : int {
    int8 = 5120,
    uint8 = 5121,
    int16 = 5122,
    uint16 = 5123,
    uint32 = 5125,
    float32 = 5126
};

/// Bytes of one number; 0 for an unknown type.
[[nodiscard]] std::size_t size_of(int component_type);
/// Numbers of an element ("VEC3" 3, "MAT4" 16); 0 for an unknown name.
[[nodiscard]] int components_of(std::string_view type);
/// An empty array of this type.
[[nodiscard]] AttributeData empty_data(int component_type);
/// The glTF type of an array's numbers; 0 if glTF has no such type (float64, int32).
[[nodiscard]] int component_type_of(const AttributeData& data);

/// A parsed document and its buffers, with the buffer views that had to be decompressed.
class Source {
  public:
    /// added: views that are not yet in a buffer, by index.
    Source(const Json& document, const std::vector<Bytes>& buffers,
           const std::map<std::size_t, Bytes>* added = nullptr)
        : json_(&document), buffers_(&buffers), added_(added) {}

    const Json& json() const { return *json_; }
    /// The bytes of a buffer view, decompressed if it uses a meshopt extension.
    Span view(const JsonCursor& reference);
    Span view(std::size_t index);
    /// True if the view's buffer has no bytes, which is legal until something reads it.
    bool without_bytes(std::size_t index) const;
    /// Bytes of a range of a buffer, checked. owner has "buffer", "byteOffset" and "byteLength".
    Span range(const JsonCursor& owner) const;
    /// Counts memory that few bytes of the file can request. Throws a limit error (E-MEMORY) when the total
    /// is too large.
    void need(double bytes);

    const Decodings* decoded = nullptr; ///< already decoded

  private:
    const Json* json_;
    const std::vector<Bytes>* buffers_;
    const std::map<std::size_t, Bytes>* added_;
    std::map<std::size_t, Bytes> decompressed_;
    double needed_ = 0;
};

/// The properties of an accessor, checked as far as possible without its bytes.
struct Accessor {
    JsonCursor place;
    std::size_t count;
    int component_type;
    int components;
    bool normalised;
};
/// The accessor that reference names. Throws a malformed-input error (E-GLTF).
[[nodiscard]] Accessor accessor(const Source& source, const JsonCursor& reference);

/// All numbers of an accessor, element by element, with sparse replacements applied. Throws a
/// malformed-input error (E-GLTF, E-BUFFER) and a limit error (E-LIMIT, when an accessor without bytes asks
/// for more than 256 MiB of zeros).
[[nodiscard]] AttributeData decode(Source& source, const Accessor& accessor);
/// The same numbers as an attribute without a name.
[[nodiscard]] Attribute decode_numbers(Source& source, const Accessor& accessor);
[[nodiscard]] Attribute decode_numbers(Source& source, std::size_t accessor);
/// The indices of a primitive, each below count. Throws a malformed-input error (E-INDEX).
[[nodiscard]] std::vector<Index> decode_indices(Source& source, const JsonCursor& reference,
                                                std::size_t count);

/// The two meshopt extensions; in the supported subset they differ only in name.
inline constexpr const char* meshopt_names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};
/// The object of EXT_meshopt_compression or KHR_meshopt_compression in a buffer or a view.
[[nodiscard]] std::optional<JsonCursor> meshopt_extension(const JsonCursor& owner);
/// Decompresses the data that a view's extension object (either name) describes. Throws a malformed-input
/// error (E-MESHOPT; also for streams that the library is too old for) and a limit error (E-MEMORY).
[[nodiscard]] Bytes decode_meshopt(Source& source, const JsonCursor& extension);

} // namespace facetmill::io::gltf
