#pragma once
// A mesh prepared for simplification, which also builds the results.

#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill::simplification {

class SimplifyInput {
  public:
    /// The settings must outlive it.
    SimplifyInput(Mesh given, const SimplifySettings& settings);
    SimplifyInput(const SimplifyInput&) = delete; // states refer to its borders
    SimplifyInput& operator=(const SimplifyInput&) = delete;

    /// The mesh to simplify: triangles, without seams that only normals make, and with faces reversed where
    /// neighbours disagree.
    const Mesh& mesh() const { return own_ ? *own_ : given_; }
    std::size_t faces() const { return mesh().face_count(); }
    std::size_t vertices() const { return used_.count; } ///< the number of vertices that faces use
    const CoincidentBorders* borders() const { return borders_ ? &*borders_ : nullptr; }

    /// Builds the state that the method needs. rollback: every collapse is logged. limits: per vertex of the
    /// mesh, see Bounds::limits; null: no limits.
    State state(bool rollback, const std::vector<float>* limits = nullptr);

    /// The unchanged input as a result. stop: why the work stopped.
    SimplifyResult unchanged(SimplifyResult::Stop stop = SimplifyResult::Stop::nothing) const;
    /// Builds the mesh of a shape. done: the totals of the work on it.
    SimplifyResult result(SimplifyResult::Stop stop, const Shape& shape, const std::optional<Log>& log,
                          const Outcome& done) const;

  private:
    NormalSeams merge_seams();
    const Mesh& prepared();
    /// A state with vertex kinds, if the method needs them. The first call also removes obstacles: it joins
    /// coincident borders and orients faces.
    State laid_out();
    State classified() const;
    /// Joins coincident borders. Locked borders match anyway.
    bool join_borders(const State& s);
    /// Reverses faces that disagree with their neighbours; otherwise their edges count as not manifold.
    bool orient_faces(const State& s);

    Mesh given_;
    const SimplifySettings& settings_;
    SimplifyLocks lock_;
    std::optional<Mesh> own_; ///< empty: the given mesh needs no change
    NormalSeams seams_;
    UsedVertices used_;
    std::optional<CoincidentBorders> borders_;
    /// [faces] 1 for faces that are reversed during the work; empty: none
    std::vector<std::uint8_t> turned_;
    SimplifyResult start_; ///< the fields that all results share
};

} // namespace facetmill::simplification
