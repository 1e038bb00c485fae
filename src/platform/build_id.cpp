#include "platform/build_id.hpp"

#include "base/hash.hpp"
#include "facetmill_version.hpp"

#include <algorithm>
#include <cstdint>
#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <span>
#include <string>
#include <sys/stat.h>
#include <vector>

namespace facetmill {

namespace {

/// The build id in the notes of a program header, as hexadecimal; empty if there is none.
std::string id_in(std::span<const unsigned char> notes) {
    constexpr std::size_t aligned = 4;
    const auto padded = [](std::size_t size) { return (size + aligned - 1) / aligned * aligned; };
    while (notes.size() >= sizeof(ElfW(Nhdr))) {
        const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(notes.data());
        const std::size_t text = sizeof *note + padded(note->n_namesz), end = text + padded(note->n_descsz);
        if (end > notes.size()) return {};
        if (note->n_type == NT_GNU_BUILD_ID) {
            std::string id;
            for (const unsigned char byte : notes.subspan(text, note->n_descsz))
                id += fmt::format("{:02x}", byte);
            return id;
        }
        notes = notes.subspan(end);
    }
    return {};
}

std::string id_of(const dl_phdr_info& info) {
    for (int i = 0; i < info.dlpi_phnum; ++i) {
        const auto& header = info.dlpi_phdr[i];
        if (header.p_type != PT_NOTE) continue;
        const auto* begin = reinterpret_cast<const unsigned char*>(info.dlpi_addr + header.p_vaddr);
        const std::string id = id_in({begin, header.p_memsz});
        if (!id.empty()) return id;
    }
    return {};
}

/// Replaces the build id of a file without one.
std::string by_file(const char* path) {
    struct stat about {};
    ::stat(path, &about);
    return fmt::format("{} {} {}.{}", FACETMILL_VERSION, about.st_size, about.st_mtim.tv_sec,
                       about.st_mtim.tv_nsec);
}

/// Called first for the program, whose name is empty, and then for each library.
int add_id(dl_phdr_info* info, std::size_t, void* out) {
    const std::string name = info->dlpi_name;
    if (name.starts_with("linux-vdso")) return 0; // provided by the kernel; computes nothing
    std::string id = id_of(*info);
    if (id.empty()) id = by_file(name.empty() ? "/proc/self/exe" : name.c_str());
    static_cast<std::vector<std::string>*>(out)->push_back(std::move(id));
    return 0;
}

std::vector<std::string> ids_of_all() {
    std::vector<std::string> ids;
    ::dl_iterate_phdr(add_id, &ids);
    return ids;
}

} // namespace

const std::string& build_id() {
    static const std::string id = ids_of_all().front();
    return id;
}

const std::string& code_id() {
    static const std::string id = [] {
        auto ids = ids_of_all();
        std::sort(ids.begin() + 1, ids.end());
        std::string text;
        for (const auto& one : ids) text += one + "\n";
        return sha256(std::as_bytes(std::span(text)));
    }();
    return id;
}

} // namespace facetmill
