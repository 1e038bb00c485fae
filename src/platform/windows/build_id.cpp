#include "platform/build_id.hpp"

#include "base/hash.hpp"
#include "facetmill_version.hpp"

#include <cstdint>
#include <cstring>
#include <fmt/format.h>
#include <span>
#include <windows.h>

namespace facetmill {

namespace {

/// The beginning of the record that the linker's --build-id writes.
struct BuildRecord {
    char signature[4];
    unsigned char id[16];
};

/// Reads the debug directory of the loaded program.
std::string id_of_program() {
    const auto* image = reinterpret_cast<const std::byte*>(::GetModuleHandleW(nullptr));
    const auto* dos = reinterpret_cast<const IMAGE_DOS_HEADER*>(image);
    const auto* headers = reinterpret_cast<const IMAGE_NT_HEADERS64*>(image + dos->e_lfanew);
    const auto& directory = headers->OptionalHeader.DataDirectory[IMAGE_DIRECTORY_ENTRY_DEBUG];
    const auto* entries = reinterpret_cast<const IMAGE_DEBUG_DIRECTORY*>(image + directory.VirtualAddress);
    std::string id;
    for (const auto& entry : std::span(entries, directory.Size / sizeof *entries)) {
        BuildRecord record{};
        if (entry.Type != IMAGE_DEBUG_TYPE_CODEVIEW || entry.SizeOfData < sizeof record) continue;
        std::memcpy(&record, image + entry.AddressOfRawData, sizeof record);
        if (std::memcmp(record.signature, "RSDS", sizeof record.signature) != 0) continue;
        for (const unsigned char byte : record.id) id += fmt::format("{:02x}", byte);
    }
    return id.empty() ? FACETMILL_VERSION : id;
}

} // namespace

const std::string& build_id() {
    static const std::string id = id_of_program();
    return id;
}

/// All libraries that compute results are part of the program.
const std::string& code_id() {
    static const std::string id = sha256(std::as_bytes(std::span(build_id())));
    return id;
}

} // namespace facetmill
