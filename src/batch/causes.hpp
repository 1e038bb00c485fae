#pragma once
// The errors and warnings of a batch, grouped by their cause.

#include "batch/batch.hpp"

namespace facetmill::batch {

/// All messages with the same id, and for checks with the same property. Their number does not grow with the
/// assets.
struct Cause {
    Severity severity = Severity::error;
    std::string id, about; ///< about: the property of a check, or the warning that became an error
    std::size_t assets = 0, messages = 0; ///< numbers of assets and of messages
    std::string first_asset, first_message;
};

/// Errors first, then by the number of assets. Assets count in the order of the inputs.
[[nodiscard]] std::vector<Cause> causes_of(const Summary& summary);
/// "E-CHECK closed"
[[nodiscard]] std::string name_of(const Cause& cause);

} // namespace facetmill::batch
