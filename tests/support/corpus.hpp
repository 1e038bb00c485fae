#pragma once
// A folder of real, hard and malformed files, given by FACETMILL_CORPUS.

#include "io/codec.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

namespace facetmill::test {

/// The folder. Without it, the test reports that it is skipped.
inline std::optional<std::filesystem::path> corpus() {
    if (const char* folder = std::getenv("FACETMILL_CORPUS")) return folder;
    std::cout << "skipped: FACETMILL_CORPUS does not name a folder of meshes\n";
    return std::nullopt;
}

/// All files below the folder with a format's suffix, sorted by name.
inline std::vector<std::filesystem::path> meshes_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && io::codec_for(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The file's scene; empty if the file is refused (tests/io checks which files are).
inline Scene read_or_nothing(const std::filesystem::path& file) {
    try {
        io::ReadLog log;
        return io::read_scene(io::Input::open(file), {}, log);
    } catch (const Error&) {
        return {};
    }
}

/// The number of cuts per mesh (FACETMILL_CORPUS_PLANES); 6 by default.
inline std::uint64_t corpus_planes() {
    const char* planes = std::getenv("FACETMILL_CORPUS_PLANES");
    return planes ? static_cast<std::uint64_t>(std::atoi(planes)) : 6;
}

/// Calls check(mesh, corpus_planes()) for all meshes of the files below the folder. Returns the number of
/// files.
template <class Check>
std::size_t check_corpus(const std::filesystem::path& folder, Check&& check) {
    std::size_t files = 0;
    for (const auto& file : meshes_below(folder)) {
        CAPTURE(file.string());
        const Scene scene = read_or_nothing(file);
        ++files;
        for (const Part& part : scene.parts) check(part.mesh, corpus_planes());
    }
    return files;
}

} // namespace facetmill::test
