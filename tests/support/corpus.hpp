#pragma once
// A folder of real, hard and malformed files, when FACETMILL_CORPUS names one.

#include "io/codec.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>

namespace facetmill::test {

/// The folder; without one, the test says that it is skipped.
inline std::optional<std::filesystem::path> corpus() {
    if (const char* folder = std::getenv("FACETMILL_CORPUS")) return folder;
    std::cout << "skipped: FACETMILL_CORPUS does not name a folder of meshes\n";
    return std::nullopt;
}

/// All files below the folder with the suffix of a format, in the order of their names.
inline std::vector<std::filesystem::path> meshes_below(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.is_regular_file() && io::codec_for(entry.path())) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// The file's scene; an empty one when it is refused (which files are is judged by tests/io).
inline Scene read_or_nothing(const std::filesystem::path& file) {
    try {
        io::ReadLog log;
        return io::read_scene(io::Input::open(file), {}, log);
    } catch (const Error&) {
        return {};
    }
}

} // namespace facetmill::test
