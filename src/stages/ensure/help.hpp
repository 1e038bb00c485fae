#pragma once
// The help and manual texts of ensure.

namespace facetmill::help::ensure {

inline constexpr const char* about =
    R"(A contract: the given properties must hold at this point, or the run fails.)";

inline constexpr const char* details =
    R"(It takes the same assertions as the common key `ensure`, but is a separate stage: it checks the
scene at this point of the pipeline. Use validate to get evidence, to check each part, to warn only, or
to judge the file after write. The mesh passes on unchanged.)";

} // namespace facetmill::help::ensure
