#include "geometry/crumple/places.hpp"

#include "base/parallel.hpp"

#include <algorithm>

namespace facetmill {

CrumplePlaces::CrumplePlaces(std::span<const CrumpleSheet> sheets) {
    struct Item {
        std::uint64_t key;
        std::uint32_t sheet;
        Index vertex;
    };
    std::vector<Item> items;
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        const auto& keys = sheets[s].moves.keys;
        for (Index v = 0; v < keys.size(); ++v) items.push_back({keys[v], static_cast<std::uint32_t>(s), v});
        of_vertex.emplace_back(keys.size());
    }
    radix_sort(items, [](const Item& i) { return i.key; });
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i == 0 || items[i].key != items[i - 1].key) ++count;
        of_vertex[items[i].sheet][items[i].vertex] = count - 1;
    }
}

void hold_together(std::span<CrumpleSheet> sheets) {
    if (std::all_of(sheets.begin(), sheets.end(), [](const auto& s) { return s.moves.shares.empty(); }))
        return;
    const CrumplePlaces places(sheets);
    std::vector<double> least(places.count, 1);
    for (std::size_t s = 0; s < sheets.size(); ++s)
        for (std::size_t v = 0; v < sheets[s].moves.shares.size(); ++v) {
            double& share = least[places.of_vertex[s][v]];
            share = std::min(share, sheets[s].moves.shares[v]);
        }
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        auto& moves = sheets[s].moves;
        parallel_for(moves.moves.size(), [&](std::size_t v) {
            const double share = least[places.of_vertex[s][v]];
            if (share < 1) moves.moves[v] *= share;
        });
        moves.shares.clear();
    }
}

} // namespace facetmill
