#pragma once
// The help and manual texts of ensure.

namespace facetmill::help::ensure {

inline constexpr const char* about =
    R"(Checks that the given properties hold at this point. Otherwise, the run fails.)";

inline constexpr const char* details =
    R"(The assertions are the same as for the common key `ensure`, but this stage checks the scene at this
point of the pipeline.
Use validate instead to get evidence, to check each part, only to warn, or to check the file after
write.
The mesh passes on unchanged.)";

} // namespace facetmill::help::ensure
