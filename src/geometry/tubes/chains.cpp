#include "geometry/tubes/chains.hpp"

#include "mesh/topology.hpp"
#include "parallel/parallel.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace facetmill {

namespace {

/// The distinct lines between points, and the lines at every point.
class LineGraph {
  public:
    explicit LineGraph(const Lines& given) : lines_(given.segments) {
        Mesh points;
        points.positions = given.points;
        const std::vector<Index> place = lowest_at_place(points);
        std::set<std::pair<Index, Index>> met;
        std::erase_if(lines_, [&](Lines::Segment& s) {
            s.from = place[s.from];
            s.to = place[s.to];
            return s.from == s.to || !met.insert(std::minmax(s.from, s.to)).second;
        });
        skipped_ = given.segments.size() - lines_.size();
        first_.assign(place.size() + 1, 0);
        for (const auto& s : lines_)
            for (const Index p : {s.from, s.to}) ++first_[p];
        exclusive_scan(first_);
        at_.resize(2 * lines_.size());
        std::vector<Index> next(first_);
        for (Index l = 0; l < lines_.size(); ++l)
            for (const Index p : {lines_[l].from, lines_[l].to}) at_[next[p]++] = l;
        done_.assign(lines_.size(), 0);
    }

    Chains chains() {
        Chains all;
        all.skipped = skipped_;
        for (Index p = 0; p + 1 < first_.size(); ++p)
            for (Index i = first_[p]; !goes_on(p) && i < first_[p + 1]; ++i)
                if (!done_[at_[i]]) all.chains.push_back(walk(p, at_[i]));
        for (Index l = 0; l < lines_.size(); ++l)
            if (!done_[l]) all.chains.push_back(walk(lines_[l].from, l));
        return all;
    }

  private:
    bool goes_on(Index p) const {
        const Index begin = first_[p];
        return first_[p + 1] - begin == 2 && lines_[at_[begin]].material == lines_[at_[begin + 1]].material;
    }

    Chain walk(Index start, Index line) {
        Chain chain{{start}, false, lines_[line].material};
        for (Index p = start;;) {
            done_[line] = 1;
            p = lines_[line].from == p ? lines_[line].to : lines_[line].from;
            if (p == start) {
                chain.closed = goes_on(p);
                if (!chain.closed) chain.points.push_back(p);
                return chain;
            }
            chain.points.push_back(p);
            if (!goes_on(p)) return chain;
            line = at_[first_[p]] == line ? at_[first_[p] + 1] : at_[first_[p]];
        }
    }

    std::vector<Lines::Segment> lines_;
    std::size_t skipped_ = 0;
    std::vector<Index> first_, at_; ///< the lines at each point
    std::vector<std::uint8_t> done_;
};

} // namespace

Chains chains_of(const Lines& lines) { return LineGraph(lines).chains(); }

} // namespace facetmill
