#pragma once
// Mesh files read face by face in bounded memory.

#include "io/codec.hpp"

#include <functional>

namespace facetmill::cells {

class ReadFile;

/// A mesh of some faces of a file.
struct Piece {
    Mesh mesh; ///< triangles; faces use every vertex
    /// [vertices] The vertex's number in the file, or a number derived from the position if positions define
    /// vertices (STL, glTF). Two pieces share a vertex if both its name and its position are equal.
    std::vector<std::uint64_t> names;
};

/// Meshes of any size, from one or several files. Larger polygons become triangles.
class FaceSource {
  public:
    virtual ~FaceSource() = default;

    struct File {
        io::Input input;                      ///< the input for inspection
        std::string sha256{};                 ///< empty: not yet known
        std::shared_ptr<const ReadFile> file; ///< the same file for reading; null if reading is finished
        bool is_rows = false;                 ///< pieces are read from it as long as they exist
    };
    struct Contents {
        std::vector<File> files;
        Box bounds;
        std::uint64_t vertices = 0;       ///< number of vertices of the files; 0 if positions define vertices
        std::vector<std::string> dropped; ///< dropped contents of the files, for messages; empty: none
        std::uint64_t skipped_faces = 0;  ///< faces with fewer than three corners
        std::string name;                 ///< name of the mesh
        std::vector<std::shared_ptr<const Document>> documents{}; ///< metadata of the files
        Unit unit = Unit::unknown;
        UpAxis up = UpAxis::unknown;
    };
    /// bounds are known after scan(). Digests and skipped_faces are known after each(), digests also after
    /// finish_digests(). Files converted to rows know all of these from the start.
    const Contents& contents() const { return contents_; }
    /// The first file's name, for messages.
    const std::string& name() const { return contents_.files.front().input.name(); }

    /// Reads the data before the faces: computes the bounds and checks that all positions are finite. Throws
    /// a malformed-input error. memory: the limit, also for data kept for the first each().
    virtual void scan(std::size_t memory) { static_cast<void>(memory); }
    /// Reads the rest of the files if their digests are not yet known.
    virtual void finish_digests() {}
    /// Restores the results of an earlier read of the unchanged files, instead of reading.
    void take_digests(const std::vector<std::string>& digests);
    void restore(const Box& bounds, std::uint64_t skipped_faces);

    /// Bytes per triangle record.
    virtual std::size_t record_size() const = 0;
    /// Calls take(centre, record) for each triangle in file order. Throws a malformed-input error. memory:
    /// the limit, plus a few megabytes.
    using Take = std::function<void(const Vec3& centre, io::Span record)>;
    virtual void each(const Take& take, std::size_t memory) = 0;
    /// Passes only the records, which needs fewer bytes of the files.
    using TakeRecord = std::function<void(io::Span record)>;
    virtual void each_record(const TakeRecord& take, std::size_t memory) = 0;
    /// If nonzero, records hold the numbers of three vertices, 32 bits each and below this limit. The
    /// numbers are also the names.
    virtual std::uint64_t vertex_numbers() const { return 0; }
    /// The triangles of records as a mesh, in their order. Thread-safe.
    virtual Piece piece(io::Span records) const = 0;
    /// The distinct vertex names in the records, ascending. Thread-safe.
    virtual std::vector<std::uint64_t> names(io::Span records) const = 0;

  protected:
    explicit FaceSource(Contents contents) : contents_(std::move(contents)) {}
    Contents& own_contents() { return contents_; }

  private:
    Contents contents_;
};

/// Maps the file unless it is small, so that only accessed parts use memory. The file must not be
/// compressed.
[[nodiscard]] io::Input open_mapped(const std::filesystem::path& path);

/// Opens an inspected file for reading. Throws a missing-file error, and a malformed-input error (E-CHANGED)
/// if its path now names another file, or if its contents changed.
[[nodiscard]] FaceSource::File open_again(const io::Input& input);
/// Opens a file for inspection and reading. Throws the errors of io::Input::open and open_again.
[[nodiscard]] FaceSource::File open_input(const std::filesystem::path& path);

/// Throws a malformed-input error (E-CHANGED) if a file, its times, or the target of its path changed since
/// it was opened.
void require_as_opened(const std::vector<FaceSource::File>& files);
/// Throws a malformed-input error (E-CHANGED) if the contents of files from which pieces are read have
/// changed. Thread-safe.
void require_unchanged(const std::vector<FaceSource::File>& files);

/// The reason for messages why a file cannot be read face by face; none if it can. Checks its first bytes
/// and its name.
[[nodiscard]] std::optional<std::string> why_not_streamed(const std::filesystem::path& path);

/// The approximate number of triangles in a file, from its header, otherwise from its size. 0 if unknown.
[[nodiscard]] std::uint64_t estimated_faces(const std::filesystem::path& path);

/// Opens files, see scan(); files that are not already rows are read and converted here. Several files, and
/// parts of a file, become a single mesh. Vertices at the same position are merged within a file and part if
/// the format needs it. Weld::exact merges them everywhere, Weld::off nowhere. scratch: a folder for
/// temporary data. memory: limit in bytes until it returns. kept: later runs reuse the results and must not
/// need temporary data, so files are read directly if possible. Throws the errors of io::read_scene, and a
/// usage error (E-CELLS) for different units and for files that why_not_streamed refuses.
[[nodiscard]] std::unique_ptr<FaceSource> open_faces(const std::vector<std::filesystem::path>& paths,
                                                     const io::ReadSettings& settings,
                                                     const std::filesystem::path& scratch,
                                                     std::size_t memory = std::size_t{64} << 20,
                                                     bool kept = false);

} // namespace facetmill::cells
