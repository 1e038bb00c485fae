#include "geometry/relax/steps.hpp"

#include "base/parallel.hpp"

#include <algorithm>
#include <memory>

namespace facetmill {

namespace {

using Method = RelaxSettings::Method;

/// hc: what the laplacian step p made of q is taken back in part, by the vertex's own difference to where it
/// should be and by that of its neighbours.
RelaxStep hc_step(const Neighbourhoods& near, const RelaxSettings& settings, const std::vector<Vec3>& start) {
    auto difference = std::make_shared<std::vector<Vec3>>(start.size());
    return [&, difference](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        umbrella_step(from, to, near.lists, relax_lambda(settings), settings.mask);
        auto& b = *difference;
        parallel_for(from.size(), [&](std::size_t v) {
            b[v] = to[v] - (start[v] * settings.alpha + from[v] * (1 - settings.alpha));
        });
        parallel_for(from.size(), [&](std::size_t v) {
            const auto others = near.lists.of(static_cast<Index>(v));
            if (others.empty()) return;
            Vec3 sum;
            for (const Index o : others) sum += b[o];
            to[v] -= b[v] * settings.beta + sum * ((1 - settings.beta) / static_cast<double>(others.size())) *
                                                (settings.mask.empty() ? 1 : settings.mask[v]);
        });
    };
}

RelaxStep taubin_step(const Neighbourhoods& near, const RelaxSettings& settings) {
    const double in = relax_lambda(settings), out = 1 / (settings.pass_band - 1 / in);
    auto middle = std::make_shared<std::vector<Vec3>>();
    return [&near, &settings, in, out, middle](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        middle->resize(from.size());
        umbrella_step(from, *middle, near.lists, in, settings.mask);
        umbrella_step(*middle, to, near.lists, out, settings.mask);
    };
}

} // namespace

double relax_lambda(const RelaxSettings& s) {
    return s.lambda.value_or(s.method == Method::taubin ? 0.5 : 1);
}

void umbrella_step(const std::vector<Vec3>& from, std::vector<Vec3>& to, const VertexLists& near,
                   double lambda, const std::vector<double>& mask) {
    const Vec3* const p = from.data();
    parallel_chunks(from.size(), [&](std::size_t begin, std::size_t end) {
        const Index* other = near.items.data() + near.offsets[begin];
        for (std::size_t v = begin; v < end; ++v) {
            const Index* const last = near.items.data() + near.offsets[v + 1];
            if (other == last) {
                to[v] = p[v];
                continue;
            }
            const auto n = static_cast<double>(last - other);
            Vec3 sum;
            for (; other != last; ++other) sum += p[*other];
            const Vec3 mean = sum / n;
            const double share = mask.empty() ? lambda : lambda * mask[v];
            to[v] = share == 1 ? mean : p[v] + (mean - p[v]) * share;
        }
    });
}

RelaxStep relax_step(const Mesh& mesh, const Neighbourhoods& near, const RelaxSettings& settings,
                     const std::vector<Vec3>& start) {
    switch (settings.method) {
    case Method::taubin:
        return taubin_step(near, settings);
    case Method::cotangent:
        return cotangent_step(mesh, near, settings);
    case Method::implicit:
        return implicit_step(near, settings);
    case Method::hc:
        return hc_step(near, settings, start);
    case Method::laplacian:
        break;
    }
    return [&near, &settings](const std::vector<Vec3>& from, std::vector<Vec3>& to) {
        umbrella_step(from, to, near.lists, relax_lambda(settings), settings.mask);
    };
}

} // namespace facetmill
