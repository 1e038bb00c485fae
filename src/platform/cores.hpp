#pragma once
// The number of cores that this process may use.

namespace facetmill {

/// The cores that the affinity of this process and the quotas of its cgroups (v1 and v2) allow, at least 1.
[[nodiscard]] int allowed_cores();

/// FACETMILL_JOBS if set, otherwise allowed_cores(). Throws a usage error (E-ARGUMENT) unless it is a number
/// from 1 to 4096.
[[nodiscard]] int default_threads();

} // namespace facetmill
