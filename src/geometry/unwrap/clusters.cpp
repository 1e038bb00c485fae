#include "geometry/unwrap/clusters.hpp"

#include "parallel/parallel.hpp"

namespace facetmill::unwrap_room {

namespace {

/// What a flat pair of clusters costs, per area of the smaller: small clusters merge first.
constexpr double flat_cost = 1e-3;

struct Cluster {
    Vec3 normal;          ///< sum of area vectors
    double area = 0;      ///< sum of their lengths
    double perimeter = 0; ///< length of its border
    Index group = none;
};

/// A common border, in both directions.
struct Border {
    Index from, to;
    double length;
};

class Clustering {
  public:
    Clustering(const UnwrapSurface& surface, const std::vector<Index>& group_of_face,
               const std::vector<double>& limit_of_group)
        : limits_(limit_of_group), cluster_of_(group_of_face.size(), none) {
        for (Index f = 0; f < group_of_face.size(); ++f) {
            if (group_of_face[f] == none) continue;
            cluster_of_[f] = static_cast<Index>(clusters_.size());
            const Vec3& n = surface.area_vectors[f];
            Cluster cluster{n, length(n), 0, group_of_face[f]};
            for (Index c = 3 * f; c < 3 * f + 3; ++c) cluster.perimeter += surface.edge_length(c);
            clusters_.push_back(cluster);
        }
        for (Index f = 0; f < group_of_face.size(); ++f)
            for (Index c = 3 * f; c < 3 * f + 3 && cluster_of_[f] != none; ++c) {
                const Index t = surface.twin[c];
                if (t != none && group_of_face[t / 3] == group_of_face[f])
                    borders_.push_back({cluster_of_[f], cluster_of_[t / 3], surface.edge_length(c)});
            }
    }

    std::vector<Index> run(std::size_t& count) {
        join_borders();
        while (merge_round()) join_borders();
        count = clusters_.size();
        return std::move(cluster_of_);
    }

  private:
    double cost(const Border& border) const {
        const Cluster &a = clusters_[std::min(border.from, border.to)],
                      &b = clusters_[std::max(border.from, border.to)];
        const double merged = length(a.normal + b.normal), area = a.area + b.area;
        if (area - merged > limits_[a.group] * area) return HUGE_VAL;
        const double increase = std::max(0.0, length(a.normal) + length(b.normal) - merged);
        const double shared = border.length, around = std::min(a.perimeter, b.perimeter);
        const double thinness = shared > 0 ? around / shared : 1e6;
        return (increase + flat_cost * std::min(a.area, b.area)) * thinness;
    }

    void join_borders() {
        const auto key = [](const Border& b) { return std::uint64_t{b.from} << 32 | b.to; };
        radix_sort(borders_, key);
        std::size_t kept = 0;
        for (const Border& b : borders_)
            if (kept > 0 && borders_[kept - 1].from == b.from && borders_[kept - 1].to == b.to)
                borders_[kept - 1].length += b.length;
            else
                borders_[kept++] = b;
        borders_.resize(kept);
        first_.assign(clusters_.size() + 1, 0);
        for (const Border& b : borders_) ++first_[b.from + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    }

    std::vector<Index> nearest() const {
        std::vector<Index> best(clusters_.size(), none);
        parallel_for(
            best.size(),
            [&](std::size_t a) {
                double least = HUGE_VAL;
                for (std::size_t i = first_[a]; i < first_[a + 1]; ++i) {
                    // Ties by the lower pair of numbers, so that the order is total.
                    const double c = cost(borders_[i]);
                    const auto pair = std::minmax({static_cast<Index>(a), borders_[i].to});
                    if (c < least || (c == least && c < HUGE_VAL &&
                                      pair < std::minmax({static_cast<Index>(a), best[a]}))) {
                        least = c;
                        best[a] = borders_[i].to;
                    }
                }
            },
            1024);
        return best;
    }

    bool merge_round() {
        const std::vector<Index> best = nearest();
        std::vector<Index> number(clusters_.size());
        std::size_t kept = 0;
        for (Index a = 0; a < clusters_.size(); ++a) {
            const Index b = best[a];
            const bool mutual = b != none && best[b] == a;
            if (mutual && b < a) {
                number[a] = number[b];
                join(clusters_[number[b]], clusters_[a]);
            } else {
                number[a] = static_cast<Index>(kept);
                clusters_[kept++] = clusters_[a];
            }
        }
        if (kept == clusters_.size()) return false;
        // The common border of a merged pair lies inside.
        for (const Border& b : borders_)
            if (number[b.from] == number[b.to]) clusters_[number[b.from]].perimeter -= b.length;
        clusters_.resize(kept);
        std::erase_if(borders_, [&](const Border& b) { return number[b.from] == number[b.to]; });
        parallel_for(borders_.size(), [&](std::size_t i) {
            borders_[i].from = number[borders_[i].from];
            borders_[i].to = number[borders_[i].to];
        });
        parallel_for(cluster_of_.size(), [&](std::size_t f) {
            if (cluster_of_[f] != none) cluster_of_[f] = number[cluster_of_[f]];
        });
        return true;
    }

    static void join(Cluster& a, const Cluster& b) {
        a.normal += b.normal;
        a.area += b.area;
        a.perimeter += b.perimeter;
    }

    const std::vector<double>& limits_;
    std::vector<Index> cluster_of_;
    std::vector<Cluster> clusters_;
    std::vector<Border> borders_;    ///< sorted, each pair once in each direction
    std::vector<std::size_t> first_; ///< [clusters + 1] offsets into borders_
};

} // namespace

std::vector<Index> cluster_faces(const UnwrapSurface& surface, const std::vector<Index>& group_of_face,
                                 const std::vector<double>& limit_of_group, std::size_t& count) {
    return Clustering(surface, group_of_face, limit_of_group).run(count);
}

} // namespace facetmill::unwrap_room
