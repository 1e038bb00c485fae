#pragma once
// A try at making one solid of clusters that intersect: cutting, rounding, and again while that intersects.

#include "geometry/boolean/boolean_pass.hpp"

#include <map>
#include <string>

namespace facetmill::clean_steps {

using Failures = std::map<Index, std::string>; ///< cluster -> why

/// The work on clusters that are tried together.
class Trial {
  public:
    Trial(Work work, const Solids& solids, const CleanSettings& settings);

    /// The clusters that cannot be united, if any. With operands, the first pass combines them.
    Failures run(const SelfIntersections& first, const Operands* operands = nullptr);
    /// The clusters whose faces do not close any more; counts the edges of more than two faces of clusters.
    Failures open_clusters(std::size_t& crowded) const;

    bool is_short_of_memory() const { return short_of_memory_; }
    Work finish();

  private:
    void fail(std::uint32_t mark, const std::string& why);
    bool one_pass(const Solids& solids, const SelfIntersections& found, double tolerance,
                  const Operands* operands, const PassBudget& effort);
    PassBudget effort(int pass) const;
    /// What rounding left: equal points, faces without area or twice, and edges that four faces share.
    void tidy();
    SelfIntersections crossings_of_fresh() const;
    void check_marks(const Solids& solids, const SelfIntersections& found);

    const CleanSettings& settings_;
    const Solids& solids_;
    Work work_;
    std::optional<EdgeTable> edges_; ///< of the mesh, where they are known
    bool is_tidy_ = false;           ///< the mesh is known to be closed, with two faces at each edge
    Failures failures_;
    bool short_of_memory_ = false;
    bool is_operation_ = false;   ///< someone asked for it, and waits as long as it takes
    std::size_t first_pairs_ = 0; ///< of triangles, in the first pass
};

} // namespace facetmill::clean_steps
