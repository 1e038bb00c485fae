#include "cells/partition/borders.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace facetmill::cells {

namespace {

/// A key that several leaves have. It has no padding bytes, because kept files must depend only on the mesh.
struct Shared {
    std::uint64_t key;
    std::uint64_t depth;
};

template <class T>
io::Span as_record(const T& value) {
    return std::as_bytes(std::span(&value, 1));
}

template <class T>
std::vector<T> records_of(io::Span bytes) {
    std::vector<T> all(bytes.size() / sizeof(T));
    if (!all.empty()) std::memcpy(static_cast<void*>(all.data()), bytes.data(), all.size() * sizeof(T));
    return all;
}

} // namespace

/// Distributes keys into buckets that fit into memory; equal keys of all leaves share a bucket.
Borders::Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
                 std::uint64_t estimate,
                 const std::function<std::vector<std::uint64_t>(std::uint32_t)>& keys_of)
    : shared_(scratch, tree.leaves.size(), static_cast<std::size_t>(memory / 16)) {
    const auto leaves = static_cast<std::uint32_t>(tree.leaves.size());
    if (leaves == 1) {
        count_ = keys_of(0).size();
        return;
    }
    const std::uint64_t buckets = buckets_of_keys(estimate, memory);
    SpillFile owned(scratch, static_cast<std::size_t>(buckets), static_cast<std::size_t>(memory / 16));
    for (std::uint32_t leaf = 0; leaf < leaves; ++leaf)
        for (const std::uint64_t key : keys_of(leaf))
            owned.add(static_cast<std::size_t>(bucket_of_key(key, buckets)), as_record(Owned{key, leaf}));
    owned.flush();
    for (std::size_t bucket = 0; bucket < buckets; ++bucket) {
        auto all = records_of<Owned>(owned.read(bucket));
        std::sort(all.begin(), all.end());
        count_ += share(tree, all);
    }
    shared_.flush();
}

Borders::Borders(const Tree& tree, const std::filesystem::path& scratch, std::uint64_t memory,
                 const NumberOwners& owners, const std::vector<std::uint32_t>& leaf_of)
    : count_(owners.count()), shared_(scratch, tree.leaves.size(), static_cast<std::size_t>(memory / 16)) {
    for (std::size_t bucket = 0; bucket < owners.buckets(); ++bucket)
        share(tree, owners.leaves(bucket, leaf_of));
    shared_.flush();
}

/// Records keys of several leaves. Returns the number of distinct keys. all: sorted.
std::uint64_t Borders::share(const Tree& tree, const std::vector<Owned>& all) {
    std::uint64_t count = 0;
    for (auto first = all.begin(); first != all.end();) {
        const auto last = std::find_if(first, all.end(), [&](const Owned& o) { return o.key != first->key; });
        ++count;
        if (last - first > 1) {
            const Shared shared{first->key, tree.common_depth(first->leaf, std::prev(last)->leaf)};
            for (auto one = first; one != last; ++one) shared_.add(one->leaf, as_record(shared));
        }
        first = last;
    }
    return count;
}

void Borders::store(const std::filesystem::path& file, bool sync, std::vector<Block>& blocks) {
    std::vector<std::size_t> all(shared_.lists());
    std::iota(all.begin(), all.end(), std::size_t{0});
    shared_ = shared_.stored(file, all, sync, blocks);
}

std::vector<std::uint8_t> Borders::homes(std::uint32_t leaf, const std::vector<std::uint64_t>& keys) const {
    auto shared = records_of<Shared>(shared_.read(leaf));
    std::sort(shared.begin(), shared.end(), [](const Shared& a, const Shared& b) { return a.key < b.key; });
    std::vector<std::uint8_t> homes(keys.size(), inner);
    for (std::size_t k = 0; k < keys.size() && !shared.empty(); ++k) {
        const auto at = std::lower_bound(shared.begin(), shared.end(), keys[k],
                                         [](const Shared& s, std::uint64_t key) { return s.key < key; });
        if (at != shared.end() && at->key == keys[k]) homes[k] = static_cast<std::uint8_t>(at->depth);
    }
    return homes;
}

} // namespace facetmill::cells
