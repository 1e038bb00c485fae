#pragma once
// The options of fit.

#include "stage/stage.hpp"

namespace facetmill::fit_stage {

enum class Compression { meshopt, draco, smallest, none };

struct FitOptions {
    PathText path;
    std::optional<ByteLimit> budget;
    std::optional<Ratio> look;
    std::int64_t pixels = 512;
    Compression compression = Compression::meshopt;
    std::string images = "webp"; ///< a format of the stage textures
    std::optional<std::int64_t> max_size;
    bool drop_names = false;

    std::size_t most_bytes() const { return budget ? static_cast<std::size_t>(*budget->max) : SIZE_MAX; }
};

void declare_fit(Declare<FitOptions>& d);
/// Checks that the declaration cannot express: a target is missing, or the file is not glTF.
void verify_fit(const FitOptions& o, const Value& given, Problems& problems);

} // namespace facetmill::fit_stage
