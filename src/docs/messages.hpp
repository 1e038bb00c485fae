#pragma once
// Documentation of error and warning ids: `facetmill explain`, its Markdown, and the manual page
// facetmill-messages(7). All texts come from base/message_ids.

#include "base/json.hpp"
#include "base/message_ids.hpp"

namespace facetmill::docs {

/// Normalises a typed id: "w-units" -> "W-UNITS".
std::string id_of(std::string text);
/// One line per id.
std::string message_list();
/// The page of an id: its meaning, its exit code, and what to do.
std::string message_page(const MessageId& message);
/// All ids as a single Markdown page.
std::string messages_markdown();
/// All ids as a manual page, facetmill-messages(7).
std::string messages_man();
/// The registry as JSON: id, severity, exit codes, meaning, hint.
Json messages_json();

} // namespace facetmill::docs
