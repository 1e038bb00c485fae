#pragma once
// An attempt to unite intersecting clusters: cut, round, and repeat while the result intersects.

#include "geometry/boolean/boolean_pass.hpp"

#include <map>
#include <string>

namespace facetmill::clean_steps {

using Failures = std::map<Index, std::string>; ///< reasons by cluster

/// The work on clusters that are united together.
class Trial {
  public:
    Trial(Work work, const Solids& solids, const CleanSettings& settings);

    /// The clusters that cannot be united. With operands, the first pass combines them.
    Failures run(const SelfIntersections& first, const Operands* operands = nullptr);
    /// The clusters whose faces are no longer closed. crowded: the number of cluster edges with more than two
    /// faces.
    Failures open_clusters(std::size_t& crowded) const;

    bool is_short_of_memory() const { return short_of_memory_; }
    Work finish();

  private:
    void fail(std::uint32_t mark, const std::string& why);
    bool one_pass(const Solids& solids, const SelfIntersections& found, double tolerance,
                  const Operands* operands, const PassBudget& effort);
    PassBudget effort(int pass) const;
    /// Cleans up after rounding: equal points, degenerate and duplicate faces, and edges with four faces.
    void tidy();
    SelfIntersections crossings_of_fresh() const;
    void check_marks(const Solids& solids, const SelfIntersections& found);

    const CleanSettings& settings_;
    const Solids& solids_;
    Work work_;
    std::optional<EdgeTable> edges_; ///< edges of the mesh, if known
    bool is_tidy_ = false;           ///< the mesh is known to be closed, with two faces at each edge
    Failures failures_;
    bool short_of_memory_ = false;
    bool is_operation_ = false;   ///< explicitly requested, so time is not limited
    std::size_t first_pairs_ = 0; ///< pairs of triangles in the first pass
};

} // namespace facetmill::clean_steps
