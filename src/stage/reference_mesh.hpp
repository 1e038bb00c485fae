#pragma once
// A mesh file that a stage takes values from, at the nearest points.

#include "geometry/transfer/transfer.hpp"
#include "stage/context.hpp"

namespace facetmill {

/// All parts of a file as triangles in world space, in the scene's unit and up axis.
class ReferenceMesh {
  public:
    /// Reads the file (read_beside). Throws a stage error (E-REFERENCE) if it has no faces.
    ReferenceMesh(const PathText& path, const Scene& scene, Context& context);
    ReferenceMesh(const ReferenceMesh&) = delete;
    ReferenceMesh& operator=(const ReferenceMesh&) = delete;

    Mesh& mesh() { return mesh_; }
    const Mesh& mesh() const { return mesh_; }
    const FaceTree& tree() const { return *tree_; }

    /// The attributes of the reference for the elements of a part: a mesh with the part's vertices, wedges
    /// and faces, in its own space. None if the part is flattened by its transform.
    struct Carried {
        Mesh mesh;
        NearestSources sources; ///< distances are in world space
    };
    [[nodiscard]] std::optional<Carried> carried_to(const Part& part) const;

  private:
    Mesh mesh_;
    std::unique_ptr<FaceTree> tree_;
};

} // namespace facetmill
