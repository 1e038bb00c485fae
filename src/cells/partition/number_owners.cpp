#include "cells/partition/number_owners.hpp"

#include "base/math/random.hpp"

#include <algorithm>
#include <cstring>

namespace facetmill::cells {

std::uint64_t buckets_of_keys(std::uint64_t estimate, std::uint64_t memory) {
    const std::uint64_t size = estimate * 2 * sizeof(Owned); // size including shared keys
    return 1 + size / std::max<std::uint64_t>(1, memory / 8);
}

std::uint64_t bucket_of_key(std::uint64_t key, std::uint64_t buckets) { return hashed(0, key) % buckets; }

NumberOwners::NumberOwners(std::uint64_t numbers, const std::filesystem::path& scratch, std::uint64_t buckets,
                           std::uint64_t memory)
    : first_(numbers, nobody), latest_(1024, {nobody, nobody}),
      others_(scratch, static_cast<std::size_t>(buckets), static_cast<std::size_t>(memory / 16)) {}

void NumberOwners::add_another(std::uint32_t number, std::uint32_t list) {
    Other& latest = latest_[number % latest_.size()];
    if (latest.number == number && latest.list == list) return;
    latest = {number, list};
    others_.add(static_cast<std::size_t>(bucket_of_key(number, buckets())),
                std::as_bytes(std::span(&latest, 1)));
}

std::uint64_t NumberOwners::count() const {
    return first_.size() - static_cast<std::uint64_t>(std::count(first_.begin(), first_.end(), nobody));
}

std::vector<Owned> NumberOwners::leaves(std::size_t bucket, const std::vector<std::uint32_t>& leaf_of) const {
    // A vertex with many faces is recorded whenever its faces alternate between lists. Duplicates are
    // dropped whenever they could be half of the entries.
    constexpr std::uint64_t part = (std::uint64_t{1} << 20) / sizeof(Other) * sizeof(Other);
    constexpr std::size_t few = 1 << 16;
    std::vector<Owned> all;
    std::size_t most = few;
    const auto drop_repeated = [&] {
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        most = std::max(few, 2 * all.size());
    };
    for (std::uint64_t begin = 0; begin < others_.size(bucket); begin += part) {
        const io::Bytes bytes = others_.read(bucket, begin, std::min(part, others_.size(bucket) - begin));
        for (std::size_t at = 0; at < bytes.size(); at += sizeof(Other)) {
            Other other;
            std::memcpy(&other, bytes.data() + at, sizeof other);
            for (const std::uint32_t list : {first_[other.number], other.list})
                if (leaf_of[list] != nobody) all.push_back({other.number, leaf_of[list]});
            if (all.size() >= most) drop_repeated();
        }
    }
    drop_repeated();
    return all;
}

} // namespace facetmill::cells
