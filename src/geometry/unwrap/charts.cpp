#include "geometry/unwrap/charts.hpp"

#include "geometry/unwrap/clusters.hpp"
#include "geometry/unwrap/join.hpp"
#include "parallel/parallel.hpp"

namespace facetmill::unwrap_room {

namespace {

/// The deviation of normals in the first charts: that of a cone of about 40 degrees around the axis.
constexpr double first_deviation = 0.12;
constexpr int most_halvings = 4; // of the deviation, before charts are cut in the middle
constexpr int rounds_alone = 10;

/// A chart that still has to be flattened.
struct Candidate {
    std::vector<Index> faces;
    double deviation = first_deviation;
    int halvings = 0;
};

class Divider {
  public:
    Divider(const UnwrapSurface& surface, double max_stretch, Gluing& gluing)
        : surface_(surface), max_stretch_(max_stretch), gluing_(gluing), group_(surface.face_count(), 0) {}

    std::vector<Chart> run() {
        std::vector<Chart> done;
        std::vector<Candidate> open(1);
        open[0].faces.resize(group_.size());
        for (Index f = 0; f < group_.size(); ++f) open[0].faces[f] = f;
        for (open = clustered(open); !open.empty();) {
            std::vector<Chart> flat(open.size());
            parallel_for(
                open.size(), [&](std::size_t i) { flat[i] = flatten(open[i].faces); }, 1);
            std::vector<Candidate> failed;
            for (std::size_t i = 0; i < open.size(); ++i)
                if (passes(flat[i]))
                    done.push_back(std::move(flat[i]));
                else
                    failed.push_back({std::move(flat[i].faces), open[i].deviation / 2, open[i].halvings + 1});
            open = divided(std::move(failed));
        }
        return done;
    }

  private:
    bool passes(const Chart& chart) const {
        return chart.faces.size() == 1 || (chart.measure.valid && chart.measure.stretch.l2 <= max_stretch_);
    }

    Chart flatten(const std::vector<Index>& faces) {
        Chart chart{faces, {}, 0};
        FlatChart flat(surface_, gluing_, chart.faces);
        flat.project();
        flat.relax(rounds_alone);
        chart.measure = flat.measure();
        if (!chart.measure.valid) {
            flat.untangle();
            chart.measure = flat.measure();
        }
        flat.store(gluing_);
        for (const BorderEdge& e : flat.border())
            chart.perimeter += surface_.edge_length(3 * chart.faces[e.corner / 3] + e.corner % 3);
        return chart;
    }

    /// Cuts every candidate into clusters of its deviation.
    std::vector<Candidate> clustered(const std::vector<Candidate>& candidates) {
        std::fill(group_.begin(), group_.end(), none);
        std::vector<double> limits;
        for (const Candidate& c : candidates) {
            for (const Index f : c.faces) group_[f] = static_cast<Index>(limits.size());
            limits.push_back(c.deviation);
        }
        std::size_t count = 0;
        const std::vector<Index> label = cluster_faces(surface_, group_, limits, count);
        return parts_of(candidates, label, count);
    }

    /// The parts of candidates by label, glued only within themselves.
    std::vector<Candidate> parts_of(const std::vector<Candidate>& candidates, const std::vector<Index>& label,
                                    std::size_t count) {
        std::vector<Candidate> parts(count);
        for (const Candidate& c : candidates)
            for (const Index f : c.faces) {
                Candidate& part = parts[label[f]];
                part.faces.push_back(f);
                part.deviation = c.deviation;
                part.halvings = c.halvings;
            }
        for (const Candidate& c : candidates)
            for (const Index f : c.faces)
                for (Index k = 3 * f; k < 3 * f + 3; ++k) {
                    const Index t = surface_.twin[k];
                    gluing_.glued[k] = t != none && group_[t / 3] == group_[f] && label[t / 3] == label[f];
                }
        return parts;
    }

    std::vector<Candidate> divided(std::vector<Candidate> failed) {
        if (failed.empty()) return {};
        std::vector<Candidate> by_normals, in_half;
        for (Candidate& c : failed)
            (c.halvings <= most_halvings ? by_normals : in_half).push_back(std::move(c));
        std::vector<Candidate> all;
        if (!by_normals.empty()) {
            all = clustered(by_normals);
            // A cluster that is still whole is cut in the middle next time.
            std::vector<std::size_t> size_before(group_.size());
            for (const Candidate& c : by_normals)
                for (const Index f : c.faces) size_before[f] = c.faces.size();
            std::erase_if(all, [&](Candidate& c) {
                if (size_before[c.faces[0]] != c.faces.size()) return false;
                c.halvings = most_halvings + 1;
                in_half.push_back(std::move(c));
                return true;
            });
        }
        if (!in_half.empty())
            for (Candidate& c : halved(in_half)) all.push_back(std::move(c));
        return all;
    }

    std::vector<Candidate> halved(const std::vector<Candidate>& candidates) {
        std::fill(group_.begin(), group_.end(), none);
        for (std::size_t i = 0; i < candidates.size(); ++i)
            for (const Index f : candidates[i].faces) group_[f] = static_cast<Index>(i);
        std::vector<Index> label(group_.size(), none);
        parallel_for(
            candidates.size(),
            [&](std::size_t i) { halve(candidates[i].faces, static_cast<Index>(2 * i), label); }, 1);
        return parts_of(candidates, label, 2 * candidates.size());
    }

    /// Grows two halves from faces that are far apart. Both are connected.
    void halve(const std::vector<Index>& faces, Index first_label, std::vector<Index>& label) {
        const std::vector<Index> once = walk({faces[0]}, first_label, label);
        for (const Index f : faces) label[f] = none;
        const std::vector<Index> twice = walk({once.back()}, first_label, label);
        for (const Index f : faces) label[f] = none;
        (void)walk({once.back(), twice.back()}, first_label, label);
    }

    /// Breadth-first order of the faces from some of them; each gets the label of its start.
    std::vector<Index> walk(std::vector<Index> order, Index first_label, std::vector<Index>& label) const {
        for (std::size_t i = 0; i < order.size(); ++i) label[order[i]] = first_label + static_cast<Index>(i);
        for (std::size_t i = 0; i < order.size(); ++i)
            for (Index c = 3 * order[i]; c < 3 * order[i] + 3; ++c) {
                const Index t = surface_.twin[c];
                if (t == none || !gluing_.glued[c] || label[t / 3] != none) continue;
                label[t / 3] = label[order[i]];
                order.push_back(t / 3);
            }
        return order;
    }

    const UnwrapSurface& surface_;
    const double max_stretch_;
    Gluing& gluing_;
    std::vector<Index> group_; ///< [faces] candidate
};

} // namespace

ChartSet make_charts(const UnwrapSurface& surface, double max_stretch) {
    ChartSet set{{}, Gluing(surface)};
    set.charts = Divider(surface, max_stretch, set.gluing).run();
    join_charts(surface, max_stretch, set);
    std::sort(set.charts.begin(), set.charts.end(),
              [](const Chart& a, const Chart& b) { return a.faces[0] < b.faces[0]; });
    return set;
}

} // namespace facetmill::unwrap_room
