#pragma once
// The stored data of a stage: its resulting scene, and separately its report.

#include "io/bytes.hpp"
#include "mesh/scene.hpp"
#include "report/record.hpp"

namespace facetmill::cache {

/// Encodes the complete scene. Equal scenes give equal bytes, independent of addresses.
[[nodiscard]] io::Bytes encoded(const Scene& scene);
/// The SHA-256 of encoded(), computed without storing the bytes.
[[nodiscard]] std::string digest_of(const Scene& scene);
/// The decoded scene; none for invalid bytes.
[[nodiscard]] std::optional<Scene> decoded_scene(io::Span bytes);
/// The approximate size of encoded(), without computing it.
[[nodiscard]] std::size_t size_of(const Scene& scene);

/// The report of a stage that need not run.
struct Memory {
    report::StageRecord record;             ///< the record without its name, position and times
    std::vector<report::FileRecord> inputs; ///< files that it read
    std::vector<std::string> absent;        ///< missing files that it looked for
    std::string scene;                      ///< key of the resulting scene
    std::string told_name;                  ///< its name, if warnings contain it; else empty
    Box bounds;                             ///< of the drawn contents of the resulting scene
};
[[nodiscard]] io::Bytes encoded(const Memory& memory);
/// Encodes the memory with this record instead of its own, to avoid a copy.
[[nodiscard]] io::Bytes encoded(const Memory& memory, const report::StageRecord& record);
[[nodiscard]] std::optional<Memory> decoded_memory(io::Span bytes);

/// A key that depends on exactly these texts.
[[nodiscard]] std::string key_of(const std::vector<std::string>& texts);

} // namespace facetmill::cache
