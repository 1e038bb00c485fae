#pragma once
// A mesh as rows in files: a row per vertex, and a row of corners per face. A binary PLY already has this
// form; other formats, and several files, are first converted to rows.

#include "cells/sources/face_source.hpp"
#include "cells/storage/block_file.hpp"
#include "io/ply/ply.hpp"

#include <array>

namespace facetmill::cells {

/// The condition for two rows to be the same vertex.
enum class Identity : std::uint8_t {
    number,         ///< rows are never the same; each row is a vertex
    place_in_group, ///< the same position, in the same group
    place           ///< the same position
};

struct Rows {
    /// Vertices from `first` to the next group: a file, or a part of a file.
    struct Group {
        std::uint64_t first = 0;
        Identity identity = Identity::number;
        bool by_use = false; ///< vertices of a piece are in the order of first use by its faces
    };
    std::shared_ptr<const ReadFile> vertices, faces;
    std::uint64_t vertices_at = 0, vertex_count = 0;
    std::uint64_t faces_at = 0, faces_end = 0, face_count = 0;
    std::vector<io::ply::Property> vertex;       ///< the fields of a row, including x, y and z; no lists
    std::vector<io::ply::Property> face;         ///< a single list, the corners
    std::int64_t vertex_line = 0, face_line = 0; ///< line numbers in the PLY file, for messages
    bool swap = false;                           ///< whether numbers have the opposite byte order
    /// The folder of faces packed by RowWriter. Empty: faces have the form of `face`.
    std::optional<std::filesystem::path> packed{};
    std::vector<Group> groups; ///< ascending; empty: a single group with Identity::number
};

/// The bytes of a vertex row.
[[nodiscard]] std::size_t row_size(const std::vector<io::ply::Property>& properties);

/// The offsets of the coordinates in a vertex row.
class Coordinates {
  public:
    /// Throws a malformed-input error (E-PLY) if a coordinate is missing.
    Coordinates(const Rows& rows, const std::string& file);
    Vec3 of(const std::byte* row) const;

  private:
    std::array<std::size_t, 3> offset_{};
    std::array<io::ply::Type, 3> type_{};
    bool swap_;
};

/// The hint of E-NAN: cells cannot drop vertices.
inline constexpr const char* not_finite_hint =
    "load: {not_finite: drop} leaves out such vertices and the faces at them; the file is read whole then";

/// The position of a file's vertex; its number is for messages. Throws a malformed-input error (E-NAN) if it
/// is not finite.
[[nodiscard]] Vec3 finite_place(const Coordinates& coordinates, const std::byte* row, std::uint64_t number,
                                const std::string& file);
/// The corners of the next face; its number is for messages. Throws a malformed-input error (E-PLY).
void read_face(const Rows& rows, const std::string& file, std::uint64_t number, Stream& faces,
               std::vector<std::uint32_t>& corners);
/// Throws a malformed-input error (E-PLY): the file ends within this item of this element.
[[noreturn]] void ends_in(const std::string& file, std::uint64_t bytes, const std::string& element,
                          std::uint64_t item, std::uint64_t count);

/// Writes rows to temporary files.
class RowWriter {
  public:
    /// extra: vertex attributes in rows besides the position. coordinate: the type of coordinates.
    RowWriter(const std::filesystem::path& scratch, std::vector<io::ply::Property> extra,
              io::ply::Type coordinate = io::ply::Type::float64);
    /// Starts a new group of vertices. by_use: see Rows::Group.
    void begin_group(Identity identity, bool by_use = false);
    /// Call it if every position in the group turns out to be unique.
    void identify_by_number() { rows_.groups.back().identity = Identity::number; }
    /// extra: the attribute bytes in the order of the properties, in native byte order.
    void vertex(const Vec3& p, io::Span extra);
    /// Adds a face by row numbers from 0. Rows may be written later. Faces of fewer than three corners are
    /// only counted.
    void face(std::span<const std::uint32_t> corners);

    std::uint64_t vertices() const { return rows_.vertex_count; }
    std::uint64_t faces() const { return rows_.face_count; }
    std::uint64_t short_faces() const { return short_faces_; }
    const Box& bounds() const { return bounds_; }
    const std::vector<io::ply::Property>& extra() const { return extra_; }
    Rows finish();

  private:
    Rows rows_;
    std::vector<io::ply::Property> extra_;
    std::size_t extra_size_;
    bool single_;      ///< coordinates are float32
    io::Bytes packed_; ///< bytes of a packed face
    std::uint32_t last_corner_ = 0;
    ScratchFile vertices_, faces_;
    Box bounds_;
    std::uint64_t short_faces_ = 0;
};

/// Reads a whole file into rows, in order.
class RowReader {
  public:
    virtual ~RowReader() = default;
    /// Vertex attributes of the file that rows can hold.
    std::vector<io::ply::Property> extra{};
    io::ply::Type coordinate = io::ply::Type::float64; ///< the file's type: float32 or float64
    std::vector<std::string> dropped{};                ///< after read: dropped contents, for messages
    std::vector<FaceSource::File> neighbours{};        ///< after read: neighbours that were read
    /// file: the input for reading. with_extra: whether the writer's rows hold `extra`. Returns the file's
    /// digest; none: see stl_rows. Throws the errors of io::read_scene.
    virtual std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out,
                             bool with_extra) = 0;
};

/// Readers by format. why_not_streamed must accept the file.
[[nodiscard]] std::unique_ptr<RowReader> gltf_rows(const io::Input& input, const io::ReadSettings& settings);
[[nodiscard]] std::unique_ptr<RowReader> obj_rows(const io::Input& input, const io::ReadSettings& settings);
[[nodiscard]] std::unique_ptr<RowReader> off_rows(const io::Input& input, const io::ReadSettings& settings);
[[nodiscard]] std::unique_ptr<RowReader> ply_rows(const io::Input& input, const io::ReadSettings& settings);
/// memory: limit in bytes. or_none: stop without a digest if faces of a binary file have attributes.
[[nodiscard]] std::unique_ptr<RowReader> stl_rows(const io::Input& input, const io::ReadSettings& settings,
                                                  std::size_t memory, bool or_none);

/// A source of rows. If the digest of the first file is unknown, the rows must be that file.
[[nodiscard]] std::unique_ptr<FaceSource> source_of(Rows rows, FaceSource::Contents contents,
                                                    const io::ReadSettings& settings);

} // namespace facetmill::cells
