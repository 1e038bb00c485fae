#include "batch/build_id.hpp"

#include <cstdint>
#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <span>
#include <sys/stat.h>

namespace facetmill::batch {

namespace {

/// The identity among the notes of a program header, as hexadecimal; empty when there is none.
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

/// Called for the program first; the libraries after it do not matter.
int find_id(dl_phdr_info* info, std::size_t, void* out) {
    for (int i = 0; i < info->dlpi_phnum; ++i) {
        const auto& header = info->dlpi_phdr[i];
        if (header.p_type != PT_NOTE) continue;
        const auto* begin = reinterpret_cast<const unsigned char*>(info->dlpi_addr + header.p_vaddr);
        const std::string id = id_in({begin, header.p_memsz});
        if (!id.empty()) *static_cast<std::string*>(out) = id;
    }
    return 1;
}

std::string by_file() {
    struct stat about {};
    ::stat("/proc/self/exe", &about);
    return fmt::format("{} {} {}.{}", FACETMILL_VERSION, about.st_size, about.st_mtim.tv_sec,
                       about.st_mtim.tv_nsec);
}

} // namespace

const std::string& build_id() {
    static const std::string id = [] {
        std::string linked;
        ::dl_iterate_phdr(find_id, &linked);
        return linked.empty() ? by_file() : linked;
    }();
    return id;
}

} // namespace facetmill::batch
