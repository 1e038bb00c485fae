#pragma once
// Files of meshes read face by face, in bounded memory.

#include "io/codec.hpp"

#include <functional>

namespace facetmill::cells {

/// Some faces of a file as a mesh.
struct Piece {
    Mesh mesh; ///< triangles, every vertex used by one
    /// [vertices] The vertex's number in the file; 0 for all where a place is what makes a vertex (STL). Two
    /// pieces share a vertex when both its name and its position are the same.
    std::vector<std::uint64_t> names;
};

/// A mesh file of any size. Faces of more than three corners come as triangles.
class FaceSource {
  public:
    virtual ~FaceSource() = default;

    /// What a scan of the whole file found.
    struct Contents {
        Box bounds;
        std::uint64_t vertices = 0; ///< the file's; 0 where it has none of its own
        std::string sha256;
    };
    const Contents& contents() const { return contents_; }
    std::uint64_t bytes() const { return input_.bytes().size(); }
    const io::Input& input() const { return input_; }
    /// What of the file is not carried, in words; empty: all is.
    const std::vector<std::string>& dropped() const { return dropped_; }
    std::uint64_t skipped_faces() const { return skipped_faces_; } ///< of fewer than three corners

    /// Bytes of a triangle's record.
    virtual std::size_t record_size() const = 0;
    /// Calls take(centre, record) for each triangle in the order of the file. Throws malformed. memory: what
    /// it may take beside a few megabytes.
    using Take = std::function<void(const Vec3& centre, io::Span record)>;
    virtual void each(const Take& take, std::size_t memory) = 0;
    /// The triangles of records as a mesh, in their order. Any thread.
    virtual Piece piece(io::Span records) const = 0;
    /// For each vertex of the records a number that equal vertices share (and others seldom), each once,
    /// ascending. Any thread.
    virtual std::vector<std::uint64_t> keys(io::Span records) const = 0;
    /// The number of a vertex of a piece.
    virtual std::uint64_t key(const Piece& piece, Index vertex) const = 0;

  protected:
    explicit FaceSource(io::Input input) : input_(std::move(input)) {}
    Contents& own_contents() { return contents_; }
    void drop(std::string what) { dropped_.push_back(std::move(what)); }
    void add_skipped_face() { ++skipped_faces_; }
    void forget_skipped_faces() { skipped_faces_ = 0; }

  private:
    io::Input input_;
    Contents contents_;
    std::vector<std::string> dropped_;
    std::uint64_t skipped_faces_ = 0;
};

/// Whether a file can be read so, by its first bytes and its name; else why not, in words.
std::optional<std::string> why_not_streamed(const std::filesystem::path& path);

/// Triangles of a file: about as many as its header says, else as its size does. 0 where that is not known.
std::uint64_t estimated_faces(const std::filesystem::path& path);

/// Opens a file, scans it once: its digest, its bounds, that all positions are finite. Throws as
/// io::read_scene, and usage (E-CELLS) where why_not_streamed would say why.
std::unique_ptr<FaceSource> open_faces(const std::filesystem::path& path, const io::ReadSettings& settings);

} // namespace facetmill::cells
