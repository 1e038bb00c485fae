#pragma once
// The guarded door: sends a file to a helper program, and gets a stream of glTF.

#include "base/json.hpp"
#include "io/codec.hpp"

#include <array>

namespace facetmill::io::import {

inline constexpr const char* scenes_helper = "facetmill-import-scenes"; ///< reads by assimp
inline constexpr const char* cad_helper = "facetmill-import-cad";       ///< reads by OCCT
inline constexpr std::array helper_names{scenes_helper, cad_helper};

/// The helper program of this name: in the folder FACETMILL_IMPORTERS, otherwise beside this executable or in
/// its ../libexec/facetmill. None if it is not an executable file.
[[nodiscard]] std::optional<std::filesystem::path> helper_program(const std::string& name);

struct DoorOrder {
    std::string program;                       ///< the name of the helper
    std::vector<std::string> arguments;        ///< further arguments
    std::vector<std::filesystem::path> read{}; ///< folders with neighbours that it may read
};

/// What a helper answers.
struct Answer {
    Json notes; ///< {warnings: [{text, hint}], files: [...], absent: [...]}
    Bytes glb;
};

/// Runs the helper on the input's bytes. Throws a malformed-input error (E-IMPORT) if it refuses the file,
/// crashes, needs too much memory or time, or answers in another form. Throws a missing-file error if it
/// cannot be started. Thread-safe: each call waits for a free worker.
[[nodiscard]] Answer ask_helper(const Input& input, const DoorOrder& order);

} // namespace facetmill::io::import
