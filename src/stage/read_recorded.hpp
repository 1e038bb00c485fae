#pragma once
// A mesh file that a stage reads.

#include "io/codec.hpp"
#include "stage/context.hpp"

#include <utility>

namespace facetmill {

/// A file that was read stands in the record, and no output may replace it. contents: the bytes themselves,
/// where they are at hand.
void record_input(Context& context, const std::string& path, std::size_t bytes, std::string sum,
                  io::Span contents = {});

/// Reads a mesh file; it and the files that it names stand among the inputs of the record, and its warnings
/// are those of the stage. codec: null for what content or suffix show. Throws as io::Input::open and
/// io::read_scene.
std::pair<Scene, io::ReadLog> read_recorded(const std::filesystem::path& path,
                                            const io::ReadSettings& settings, const io::Codec* codec,
                                            Context& context);

/// Reads the mesh file that an option names, in the scene's unit and up axis. Warns (W-UNITS) where
/// one of them states no unit and is a hundred times as large as the other. Throws as above.
Scene read_beside(const PathText& path, const Scene& scene, Context& context);

} // namespace facetmill
