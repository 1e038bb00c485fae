#pragma once
// Reads a mesh file for a stage.

#include "io/codec.hpp"
#include "stage/context.hpp"

#include <utility>

namespace facetmill {

/// Records an input file, so that no output may replace it. contents: its bytes, if available.
void record_input(Context& context, const std::string& path, std::size_t bytes, std::string sum,
                  io::Span contents = {});

/// Reads a mesh file. Records it and the files that it refers to as inputs, and adds its warnings to the
/// stage. codec: null to detect it from content or suffix. Throws the errors of io::Input::open and
/// io::read_scene.
[[nodiscard]] std::pair<Scene, io::ReadLog> read_recorded(const std::filesystem::path& path,
                                                          const io::ReadSettings& settings,
                                                          const io::Codec* codec, Context& context);

/// Reads the mesh file of an option, in the scene's unit and up axis. Warns if both are the same shape in
/// another unit or up axis (W-CONVENTION), or if one of the scenes has no unit and their sizes differ by a
/// factor of a hundred (W-UNITS). compares: false if another up axis is no mistake. Throws the errors of
/// read_recorded.
[[nodiscard]] Scene read_beside(const PathText& path, const Scene& scene, Context& context,
                                bool compares = true);

} // namespace facetmill
