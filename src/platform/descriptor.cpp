#include "platform/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

namespace facetmill {

Descriptor Descriptor::borrowed(int number) {
    Descriptor file(number);
    file.is_borrowed_ = true;
    return file;
}

bool Descriptor::close() noexcept {
    const int number = std::exchange(number_, -1);
    return number < 0 || is_borrowed_ || ::close(number) == 0;
}

Descriptor open_file(const std::filesystem::path& path, const OpenOptions& options) {
    int flags = O_CLOEXEC | (options.what == OpenFor::reading   ? O_RDONLY
                             : options.what == OpenFor::writing ? O_WRONLY
                                                                : O_RDWR);
    if (options.create != Create::no) flags |= O_CREAT;
    if (options.create == Create::always) flags |= O_EXCL;
    if (options.truncates) flags |= O_TRUNC;
    if (options.appends) flags |= O_APPEND;
    if (!options.follows_links) flags |= O_NOFOLLOW;
    if (!options.waits) flags |= O_NONBLOCK;
    if (options.is_folder) flags |= O_DIRECTORY;
    return Descriptor(::open(path.c_str(), flags, options.permissions));
}

Descriptor duplicate(const Descriptor& file) { return Descriptor(::dup(file.number())); }

} // namespace facetmill
