#pragma once
// Archives as inputs and outputs of a batch: tar and zip.

#include "batch/batch.hpp"

namespace facetmill::batch {

/// The folder below an output folder in which an archive is unpacked. It is the same in the next batch, so
/// that unchanged assets are kept.
[[nodiscard]] std::filesystem::path unpack_folder(const std::filesystem::path& output_dir,
                                                  const std::string& archive);

/// Unpacks an archive ("-": a tar on standard input) into a new folder, and returns the paths of its meshes
/// in it, sorted by bytes. The contents decide whether it is a tar (also compressed) or a zip. Throws the
/// errors of the archive's format, and a malformed-input error (E-ARCHIVE) for names that leave the folder
/// or occur twice. Zips and compressed tars beyond io::most_unpacked are refused (E-SIZE).
[[nodiscard]] std::vector<std::string> unpack_archive(const std::string& archive,
                                                      const std::filesystem::path& folder);

/// Whether outputs can be packed into a file of this name: .tar, .zip, or - for a tar on standard output.
bool is_archive_name(const std::string& path);
/// Packs the outputs and reports of all successful assets, in the order of the inputs. target: the file, or
/// "-".
void write_archive(const Summary& summary, const std::filesystem::path& target);

} // namespace facetmill::batch
