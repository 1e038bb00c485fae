#include "mesh/attribute_changes.hpp"

#include <algorithm>

namespace facetmill {
namespace {

auto find_same(const AttributeChanges& changes, const AttributeChange& one) {
    return std::find_if(changes.begin(), changes.end(), [&](const AttributeChange& other) {
        return other.attribute == one.attribute && other.domain == one.domain;
    });
}

} // namespace

const char* to_string(AttributeChange::Kind kind) {
    switch (kind) {
    case AttributeChange::Kind::kept:
        return "kept";
    case AttributeChange::Kind::interpolated:
        return "interpolated";
    case AttributeChange::Kind::recomputed:
        return "recomputed";
    case AttributeChange::Kind::dropped:
        break;
    }
    return "dropped";
}

AttributeChanges kept_changes(const std::vector<Attribute>& attributes) {
    AttributeChanges changes;
    for (const Attribute& a : attributes)
        changes.push_back({a.name, a.domain, AttributeChange::Kind::kept, {}});
    return changes;
}

void merge_changes(AttributeChanges& all, const AttributeChanges& more) {
    for (const AttributeChange& change : more) {
        const auto same = find_same(all, change);
        if (same == all.end())
            all.push_back(change);
        else if (change.kind != AttributeChange::Kind::kept)
            all[static_cast<std::size_t>(same - all.begin())] = change;
    }
}

AttributeChanges changes_in_sequence(const AttributeChanges& first, AttributeChanges second) {
    for (AttributeChange& change : second) {
        if (change.kind != AttributeChange::Kind::kept) continue;
        const auto earlier = find_same(first, change);
        if (earlier != first.end()) change = *earlier;
    }
    return second;
}

void forget_change(AttributeChanges& changes, std::string_view attribute) {
    std::erase_if(changes, [&](const AttributeChange& change) { return change.attribute == attribute; });
}

} // namespace facetmill
