#pragma once
// A mesh as rows in files: one of a vertex, one of the corners of a face. That of a binary PLY is the file
// itself; files of other formats, and several files, are written as rows first.

#include "cells/sources/face_source.hpp"
#include "cells/storage/block_file.hpp"
#include "io/ply/ply.hpp"

#include <array>

namespace facetmill::cells {

/// What makes two rows one vertex.
enum class Identity : std::uint8_t {
    number,         ///< nothing: each row is one
    place_in_group, ///< the same position, in the same group
    place           ///< the same position
};

struct Rows {
    /// Vertices from `first` up to the next group's. A file, or a part of it.
    struct Group {
        std::uint64_t first = 0;
        Identity identity = Identity::number;
        bool by_use = false; ///< vertices of a piece are in the order in which its faces name them first
    };
    std::shared_ptr<const ReadFile> vertices, faces;
    std::uint64_t vertices_at = 0, vertex_count = 0;
    std::uint64_t faces_at = 0, faces_end = 0, face_count = 0;
    std::vector<io::ply::Property> vertex;       ///< what a row holds, x, y and z among it; no lists
    std::vector<io::ply::Property> face;         ///< one list, the corners
    std::int64_t vertex_line = 0, face_line = 0; ///< of the PLY file, for messages
    bool swap = false;                           ///< whether numbers have the other order of bytes
    /// Faces are as RowWriter packs them, in this folder; none: as `face` says.
    std::optional<std::filesystem::path> packed{};
    std::vector<Group> groups; ///< ascending; empty: one, Identity::number
};

/// The bytes of a row of a vertex.
std::size_t row_size(const std::vector<io::ply::Property>& properties);

/// Where the coordinates of a vertex stand in its row.
class Coordinates {
  public:
    /// Throws malformed (E-PLY) when one is missing.
    Coordinates(const Rows& rows, const std::string& file);
    Vec3 of(const std::byte* row) const;

  private:
    std::array<std::size_t, 3> offset_{};
    std::array<io::ply::Type, 3> type_{};
    bool swap_;
};

/// The hint of E-NAN: cells leave out nothing.
inline constexpr const char* not_finite_hint =
    "load: {not_finite: drop} leaves out such vertices and the faces at them; the file is read whole then";

/// The position of a vertex of a file; its number is for messages. Throws malformed (E-NAN) when it is not
/// finite.
Vec3 finite_place(const Coordinates& coordinates, const std::byte* row, std::uint64_t number,
                  const std::string& file);
/// The corners of the next face; its number is for messages. Throws malformed (E-PLY).
void read_face(const Rows& rows, const std::string& file, std::uint64_t number, Stream& faces,
               std::vector<std::uint32_t>& corners);
/// Throws malformed (E-PLY): the file ends in that item of that element.
[[noreturn]] void ends_in(const std::string& file, std::uint64_t bytes, const std::string& element,
                          std::uint64_t item, std::uint64_t count);

/// Rows that are written to temporary files.
class RowWriter {
  public:
    /// extra: attributes of vertices that rows hold beside the position, whose coordinates are `coordinate`s.
    RowWriter(const std::filesystem::path& scratch, std::vector<io::ply::Property> extra,
              io::ply::Type coordinate = io::ply::Type::float64);
    /// Vertices that follow are of another group. by_use: see Rows::Group.
    void begin_group(Identity identity, bool by_use = false);
    /// The group turns out to have each place once.
    void identify_by_number() { rows_.groups.back().identity = Identity::number; }
    /// extra: the attributes as the properties say, this machine's bytes.
    void vertex(const Vec3& p, io::Span extra);
    /// Rows that were or will be written, counted from the first. Faces of fewer than three corners are
    /// counted only.
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
    io::Bytes packed_; ///< a face
    std::uint32_t last_corner_ = 0;
    ScratchFile vertices_, faces_;
    Box bounds_;
    std::uint64_t short_faces_ = 0;
};

/// Reads a file into rows, from its beginning to its end.
class RowReader {
  public:
    virtual ~RowReader() = default;
    /// Attributes that vertices have in the file, as far as rows carry them.
    std::vector<io::ply::Property> extra{};
    io::ply::Type coordinate = io::ply::Type::float64; ///< what holds those of the file: float32 or float64
    std::vector<std::string> dropped{};                ///< after read: what is not carried, in words
    std::vector<FaceSource::File> neighbours{};        ///< after read: other files that were read
    /// file: the input, to be read. with_extra: whether the writer's rows hold `extra`; else they hold none.
    /// Throws as io::read_scene. Returns the file's digest; none: see stl_rows.
    virtual std::string read(const std::shared_ptr<const ReadFile>& file, RowWriter& out,
                             bool with_extra) = 0;
};

/// Readers, by format. The file must be one that why_not_streamed has no word against.
std::unique_ptr<RowReader> gltf_rows(const io::Input& input, const io::ReadSettings& settings);
std::unique_ptr<RowReader> obj_rows(const io::Input& input, const io::ReadSettings& settings);
std::unique_ptr<RowReader> off_rows(const io::Input& input, const io::ReadSettings& settings);
std::unique_ptr<RowReader> ply_rows(const io::Input& input, const io::ReadSettings& settings);
/// memory: bytes that reading may take. or_none: it ends, without a digest, where faces of a binary file have
/// attributes.
std::unique_ptr<RowReader> stl_rows(const io::Input& input, const io::ReadSettings& settings,
                                    std::size_t memory, bool or_none);

/// A source of rows. Where the digest of the first file is not known, the rows are this file.
std::unique_ptr<FaceSource> source_of(Rows rows, FaceSource::Contents contents,
                                      const io::ReadSettings& settings);

} // namespace facetmill::cells
