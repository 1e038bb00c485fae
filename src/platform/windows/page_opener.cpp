#include "platform/page_opener.hpp"

#include "platform/windows/child_processes.hpp"

#include <cstdint>
#include <windows.h>

#include <shellapi.h>

namespace facetmill {

/// Windows needs no helper process, but the right to start the browser.
PageOpener::PageOpener() { needs_child_processes = true; }

bool PageOpener::open(const std::filesystem::path& page) const {
    constexpr std::intptr_t last_error = 32;
    const auto name = std::filesystem::absolute(page).make_preferred();
    const auto* done = ::ShellExecuteW(nullptr, L"open", name.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
    return reinterpret_cast<std::intptr_t>(done) > last_error;
}

} // namespace facetmill
