#pragma once
// A mesh made ready to be simplified, and how results of it are made.

#include "geometry/simplify/features.hpp"
#include "geometry/simplify/methods.hpp"

namespace facetmill::simplification {

class SimplifyInput {
  public:
    /// The settings must outlive it.
    SimplifyInput(Mesh given, const SimplifySettings& settings);
    SimplifyInput(const SimplifyInput&) = delete; // states refer to its borders
    SimplifyInput& operator=(const SimplifyInput&) = delete;

    /// What the work is done on: triangles, without the seams that only normals make, and turned round where
    /// neighbours disagree.
    const Mesh& mesh() const { return own_ ? *own_ : given_; }
    std::size_t faces() const { return mesh().face_count(); }
    std::size_t vertices() const { return used_.count; } ///< that faces use
    const CoincidentBorders* borders() const { return borders_ ? &*borders_ : nullptr; }

    /// All that the method needs. rollback: every collapse is logged. limits: see Bounds::limits, of the
    /// vertices of the mesh; null: none.
    State state(bool rollback, const std::vector<float>* limits = nullptr);

    /// The mesh as it came. stop: why no more was done.
    SimplifyResult unchanged(SimplifyResult::Stop stop = SimplifyResult::Stop::nothing) const;
    /// The mesh of a shape. done: all that led to it.
    SimplifyResult result(SimplifyResult::Stop stop, const Shape& shape, const std::optional<Log>& log,
                          const Outcome& done) const;

  private:
    NormalSeams merge_seams();
    const Mesh& prepared();
    /// A state with kinds, where the method has use for them. What is in the way of them is put right the
    /// first time.
    State laid_out();
    State classified() const;
    /// Joins borders that run along each other. Locked ones match anyway.
    bool join_borders(const State& s);
    /// Turns faces round whose neighbours disagree with them: else the edges there count as not manifold.
    bool orient_faces(const State& s);

    Mesh given_;
    const SimplifySettings& settings_;
    SimplifyLocks lock_;
    std::optional<Mesh> own_; ///< none: the mesh as given will do
    NormalSeams seams_;
    UsedVertices used_;
    std::optional<CoincidentBorders> borders_;
    /// [faces] 1 for those that the work is done on turned round; empty: none
    std::vector<std::uint8_t> turned_;
    SimplifyResult start_; ///< what all results have in common
};

} // namespace facetmill::simplification
