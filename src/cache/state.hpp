#pragma once
// The stored results of a stage: its output scene and, separately, everything that the run reports of it.

#include "io/bytes.hpp"
#include "mesh/scene.hpp"
#include "report/record.hpp"

namespace facetmill::cache {

/// The whole scene: equal bytes for equal scenes, whatever their addresses.
io::Bytes encoded(const Scene& scene);
/// The SHA-256 of encoded(), without a copy of the scene.
std::string digest_of(const Scene& scene);
/// None for bytes that are no scene.
std::optional<Scene> decoded_scene(io::Span bytes);
/// About as many bytes as encoded() gives, without making them.
std::size_t size_of(const Scene& scene);

/// The report of a stage that need not run again.
struct Memory {
    report::StageRecord record;             ///< without its name, place and times
    std::vector<report::FileRecord> inputs; ///< files that it read
    std::vector<std::string> absent;        ///< files that it looked for and that did not exist
    std::string scene;                      ///< the key of the scene that left it
    std::string told_name;                  ///< its name, if its warnings have it; else empty
    Box bounds;                             ///< of that scene
};
io::Bytes encoded(const Memory& memory);
/// With that record in the place of its own, which is not copied.
io::Bytes encoded(const Memory& memory, const report::StageRecord& record);
std::optional<Memory> decoded_memory(io::Span bytes);

/// A key of whatever depends on these texts and nothing else.
std::string key_of(const std::vector<std::string>& texts);

} // namespace facetmill::cache
