#include "platform/temporary_files.hpp"

#include "platform/file_names.hpp"

#include <cerrno>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <unistd.h>

namespace facetmill {

namespace fs = std::filesystem;

Descriptor unnamed_file(const fs::path& folder) {
    Descriptor nameless(::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600));
    if (nameless || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) return nameless;
    for (int attempt = 0;; ++attempt) { // fallback for file systems without unnamed files
        const fs::path path = folder / temporary_name("cells", attempt);
        Descriptor named =
            open_file(path, {.what = OpenFor::both, .create = Create::always, .permissions = 0600});
        if (!named && errno == EEXIST) continue;
        if (named) remove_file(path);
        return named;
    }
}

fs::path temporary_folder(const std::string& begin_of_name) {
    std::error_code failed;
    const fs::path above = fs::temp_directory_path(failed);
    std::string name = ((failed ? fs::path("/tmp") : above) / (begin_of_name + "XXXXXX")).string();
    return ::mkdtemp(name.data()) ? fs::path(name) : fs::path();
}

int process_id() { return ::getpid(); }

bool is_running(int process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

} // namespace facetmill
