#pragma once
// PLY in steps: the header, the elements as typed columns, and the conversion to a mesh.

#include "io/codec.hpp"
#include "io/stated.hpp"

#include <string>
#include <vector>

namespace facetmill::io::ply {

/// The eight scalar types, in the order of AttributeData's alternatives.
enum class Type { float32, float64, uint8, int8, uint16, int16, uint32, int32 };
[[nodiscard]] std::size_t size_of(Type type);
/// An empty array of the type.
[[nodiscard]] AttributeData array_of(Type type);

struct Property {
    std::string name;
    Type type = Type::float32;
    bool list = false;
    Type count_type = Type::uint8;
};

struct Element {
    std::string name;
    std::size_t count = 0;
    std::vector<Property> properties;
    std::int64_t line = 0; ///< the header line that declares the element
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
    Encoding encoding = Encoding::ascii;
    std::vector<Element> elements;
    std::size_t size = 0;              ///< the length of the header in bytes
    std::int64_t lines = 0;            ///< the number of header lines
    std::vector<std::string> textures; ///< file names from 'TextureFile' comments of some programs
    Stated stated{};                   ///< the unit and up axis that comments state
    /// Other comments and lines of obj_info, except comments that name the program that wrote the file.
    std::vector<std::string> comments{};
    bool own = false; ///< facetmill wrote the file, so that its fractions of colours may exceed 2
};

/// Reads the header; throws a malformed-input error (E-PLY) with the line.
[[nodiscard]] Header read_header(const Input& input);

/// The values of a property for all items of its element.
struct Column {
    AttributeData values;
    std::vector<std::size_t>
        offsets; ///< [count + 1] list offsets into values; empty if all items have `each` values
    std::size_t each = 1;

    std::size_t begin(std::size_t i) const { return offsets.empty() ? i * each : offsets[i]; }
    std::size_t size(std::size_t i) const { return offsets.empty() ? each : offsets[i + 1] - offsets[i]; }
};

/// Reads elements in order. Allocates no more than the remaining bytes could fill.
class Body {
  public:
    Body(const Input& input, const Header& header);
    ~Body();
    /// The columns of the next element, in the order of its properties.
    std::vector<Column> read(const Element& element);
    /// The number of bytes after the elements read so far, 0 if only ends of lines or blanks follow.
    std::size_t left() const;

  private:
    struct Reader;
    std::unique_ptr<Reader> reader_;
};

/// The name of the part for the file's lines, if the file also has faces or points.
inline constexpr const char* part_of_lines = "lines";

[[nodiscard]] Scene read(const Input& input, const ReadSettings& settings, ReadLog& log);
[[nodiscard]] Written write(const Scene& scene, const WriteSettings& settings);

} // namespace facetmill::io::ply
