#pragma once
// Files of meshes read face by face, in bounded memory.

#include "io/codec.hpp"

#include <functional>

namespace facetmill::cells {

class ReadFile;

/// Some faces of a file as a mesh.
struct Piece {
    Mesh mesh; ///< triangles, every vertex used by one
    /// [vertices] The vertex's number in the file; where a place is what makes a vertex (STL, glTF), a number
    /// that its place gives it. Two pieces share a vertex when both its name and its position are the same.
    std::vector<std::uint64_t> names;
};

/// Meshes of any size, from one or several files. Faces of more than three corners come as triangles.
class FaceSource {
  public:
    virtual ~FaceSource() = default;

    struct File {
        io::Input input;                      ///< what is looked at
        std::string sha256{};                 ///< empty: not known yet
        std::shared_ptr<const ReadFile> file; ///< the same, to be read; null where that is done
        bool is_rows = false;                 ///< pieces are read from it, as long as there are any
    };
    struct Contents {
        std::vector<File> files;
        Box bounds;
        std::uint64_t vertices = 0;       ///< of the files; 0 where places are what makes them
        std::vector<std::string> dropped; ///< what of the files is not carried, in words; empty: all is
        std::uint64_t skipped_faces = 0;  ///< of fewer than three corners
        std::string name;                 ///< of the mesh
        Unit unit = Unit::unknown;
        UpAxis up = UpAxis::unknown;
    };
    /// bounds are known after scan(), digests and skipped_faces after each(); digests after finish_digests(),
    /// too. Where files are written as rows first, they are known from the beginning.
    const Contents& contents() const { return contents_; }
    /// The first file's name, for messages.
    const std::string& name() const { return contents_.files.front().input.name(); }

    /// Reads what comes before the faces: bounds, and that all positions are finite. Throws malformed.
    /// memory: what it may take, and hold for the first each().
    virtual void scan(std::size_t memory) { static_cast<void>(memory); }
    /// Reads the rest of the files where their digests are not known yet.
    virtual void finish_digests() {}
    /// In place of reading: what was found when the files were read, which are as they were.
    void take_digests(const std::vector<std::string>& digests);
    void restore(const Box& bounds, std::uint64_t skipped_faces);

    /// Bytes of a triangle's record.
    virtual std::size_t record_size() const = 0;
    /// Calls take(centre, record) for each triangle in the order of the file. Throws malformed. memory: what
    /// it may take beside a few megabytes.
    using Take = std::function<void(const Vec3& centre, io::Span record)>;
    virtual void each(const Take& take, std::size_t memory) = 0;
    /// The records alone, which needs fewer bytes of the files.
    using TakeRecord = std::function<void(io::Span record)>;
    virtual void each_record(const TakeRecord& take, std::size_t memory) = 0;
    /// More than 0: records are the numbers of three vertices, 32 bits each and below this, which are their
    /// names.
    virtual std::uint64_t vertex_numbers() const { return 0; }
    /// The triangles of records as a mesh, in their order. Any thread.
    virtual Piece piece(io::Span records) const = 0;
    /// For each vertex of the records its name, each once, ascending. Any thread.
    virtual std::vector<std::uint64_t> names(io::Span records) const = 0;

  protected:
    explicit FaceSource(Contents contents) : contents_(std::move(contents)) {}
    Contents& own_contents() { return contents_; }

  private:
    Contents contents_;
};

/// Mapped unless it is small, so that only what is looked at takes memory. The file must not be compressed.
io::Input open_mapped(const std::filesystem::path& path);

/// Opens a file that was looked at once more, to be read. Throws missing; malformed (E-CHANGED) where its
/// path names another file by now, or its contents are others.
FaceSource::File open_again(const io::Input& input);
/// A file to be looked at and to be read. Throws as io::Input::open, and as above.
FaceSource::File open_input(const std::filesystem::path& path);

/// Throws malformed (E-CHANGED) when one of the files, or what its path names, is another than when it was
/// opened, or has other times.
void require_as_opened(const std::vector<FaceSource::File>& files);
/// The same of the contents of those files that pieces are read from. Any thread.
void require_unchanged(const std::vector<FaceSource::File>& files);

/// Whether a file can be read so, by its first bytes and its name; else why not, in words.
std::optional<std::string> why_not_streamed(const std::filesystem::path& path);

/// Triangles of a file: about as many as its header says, else as its size does. 0 where that is not known.
std::uint64_t estimated_faces(const std::filesystem::path& path);

/// Opens files, see scan(); those that are not rows themselves are read and written as rows here. Several
/// files, and parts of a file, become one mesh. Vertices of one place are one where the format needs it,
/// within a file and part; with Weld::exact everywhere, with Weld::off nowhere. scratch: a folder for
/// temporary data. memory: bytes that may be taken until it returns. kept: other runs take up what becomes of
/// the faces, and are to need nothing that is written here: what can be read as it is, is. Throws as
/// io::read_scene, and usage (E-CELLS) where why_not_streamed would say why, or units differ.
std::unique_ptr<FaceSource> open_faces(const std::vector<std::filesystem::path>& paths,
                                       const io::ReadSettings& settings, const std::filesystem::path& scratch,
                                       std::size_t memory = std::size_t{64} << 20, bool kept = false);

} // namespace facetmill::cells
