// Implements queries of many lines of geometry/spatial/rays.hpp.
#include "base/progress.hpp"
#include "geometry/spatial/hilbert_curve.hpp"
#include "geometry/spatial/rays_walk.hpp"
#include "parallel/parallel.hpp"

namespace facetmill {

namespace {

/// Interleaves several searches. A search mostly waits for memory (nodes and triangles that no earlier line
/// visited), and meanwhile the others continue. A million segments on 1.1M faces take 2.0 CPU s separately,
/// 1.3 with four interleaved, and 1.1 with eight.
class Turns {
  public:
    Turns(const FaceTree& tree, std::span<const Line> lines, std::span<const Index> order, bool all)
        : tree_(tree), lines_(lines), order_(order), all_(all) {}

    /// found(i, hits) for lines[order[i]], in no order.
    template <class Found>
    void run(Found&& found) {
        std::vector<Lane*> active;
        for (auto& lane : lanes_)
            if (start(lane)) active.push_back(&lane);
        while (!active.empty())
            for (std::size_t i = 0; i < active.size();) {
                Lane& lane = *active[i];
                if (lane.search->step()) {
                    ++i;
                    continue;
                }
                found(lane.of, lane.search->hits());
                if (!start(lane)) {
                    active[i] = active.back();
                    active.pop_back();
                }
            }
    }

  private:
    struct Lane {
        std::optional<rays::LineSearch> search;
        std::size_t of = 0;
    };

    /// Gives the lane the next line. Returns false if no line is left.
    bool start(Lane& lane) {
        while (next_ < order_.size()) {
            if (next_ + lanes_.size() < order_.size()) fetch_soon(lines_[order_[next_ + lanes_.size()]]);
            lane.of = next_++;
            const Line& line = lines_[order_[lane.of]];
            if (!rays::is_line(line)) continue;
            lane.search.emplace(tree_, line, all_);
            return true;
        }
        return false;
    }

    const FaceTree& tree_;
    std::span<const Line> lines_;
    std::span<const Index> order_;
    bool all_;
    std::size_t next_ = 0;
    std::array<Lane, 8> lanes_;
};

} // namespace

HitLists hits_of(const FaceTree& tree, std::span<const Line> lines, bool all) {
    Box box;
    for (const auto& line : lines)
        if (is_finite(line.from)) box.add(line.from);
    const auto order = order_along_curve(lines.size(), box, [&](std::size_t i) { return lines[i].from; });
    struct Found {
        std::size_t line;
        Hit hit;
    };
    constexpr std::size_t chunk = 256;
    std::vector<std::vector<Found>> found((lines.size() + chunk - 1) / chunk);
    std::vector<std::size_t> counts(lines.size() + 1);
    ProgressScope::report_next_loop();
    parallel_chunks(
        lines.size(),
        [&](std::size_t begin, std::size_t end) {
            const auto mine = std::span(order).subspan(begin, end - begin);
            Turns(tree, lines, mine, all).run([&](std::size_t i, const std::vector<Hit>& hits) {
                counts[mine[i]] = hits.size();
                for (const auto& hit : hits) found[begin / chunk].push_back({mine[i], hit});
            });
        },
        chunk);
    HitLists lists;
    lists.offsets = std::move(counts);
    lists.hits.resize(exclusive_scan(lists.offsets));
    for (const auto& some : found)
        for (std::size_t i = 0, in_line = 0; i < some.size(); ++i) {
            in_line = i > 0 && some[i - 1].line == some[i].line ? in_line + 1 : 0;
            lists.hits[lists.offsets[some[i].line] + in_line] = some[i].hit;
        }
    return lists;
}

} // namespace facetmill
