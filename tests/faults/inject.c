// Loaded before the C library (LD_PRELOAD): makes one call of the system fail, or kills the process just before it.
//
//   FACETMILL_FAULT="CLASS N ERROR"   the N-th call of a class fails: ERROR is an errno, -9 kills, 0 only counts
//                                     (with N -1 the log gets a line for each call of the class, in their order);
//                                     malloc: from the N-th on there is no more memory than what is in use then
//   FACETMILL_FAULT_LOG=FILE          gets a line for the call that failed ("CLASS N NAME PATH"), and at the end
//                                     "CLASS COUNT" for each class
//
// Classes are in `names` below; "any" numbers the calls of all classes but malloc in one sequence. Calls count from the
// start of main to its return. What the C library calls inside itself (a FILE's writes) is not seen.
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <malloc.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum Class { OPEN, READ, WRITE, SYNC, RENAME, LINK, UNLINK, MKDIR, STAT, MMAP, CLOSE, MALLOC, ANY, CLASSES };
static const char* const names[CLASSES] = {"open",  "read", "write", "sync",  "rename", "link", "unlink",
                                           "mkdir", "stat", "mmap",  "close", "malloc", "any"};

extern void* __libc_malloc(size_t);
extern void* __libc_calloc(size_t, size_t);
extern void* __libc_realloc(void*, size_t);
extern void* __libc_memalign(size_t, size_t);
extern void __libc_free(void*);

static atomic_int armed;
static atomic_long counts[CLASSES];
static enum Class chosen = CLASSES;
static long chosen_call;
static int chosen_error;
static int log_file = -1;

static void put(const char* text) {
    const ssize_t ignored = syscall(SYS_write, log_file, text, strlen(text));
    (void)ignored;
}

static void put_line(const char* name, long count, const char* function, const char* path) {
    char line[2 * 4096];
    snprintf(line, sizeof line, "%s %ld %s %s\n", name, count, function, path ? path : "");
    put(line);
}

static const char* path_of(int fd, char* room, size_t size) {
    char link[64];
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    const ssize_t n = syscall(SYS_readlink, link, room, size - 1);
    room[n < 0 ? 0 : n] = 0;
    return room;
}

/// Whether this call is to fail; errno is set. path: may be null, then fd tells it.
static int fails(enum Class class, const char* function, const char* path, int fd) {
    if (!atomic_load_explicit(&armed, memory_order_relaxed)) return 0;
    const long call = atomic_fetch_add(&counts[class], 1) + 1;
    const long of_any = class == MALLOC ? 0 : atomic_fetch_add(&counts[ANY], 1) + 1;
    if ((chosen == class || (chosen == ANY && class != MALLOC)) && chosen_call == -1) {
        char room[4096];
        put_line(names[class], call, function, path ? path : fd >= 0 ? path_of(fd, room, sizeof room) : "");
    }
    const int is_it = chosen == class ? call == chosen_call : chosen == ANY && of_any == chosen_call;
    if (!is_it || chosen_error == 0) return 0;
    atomic_store(&armed, 0); // what is told of it is no call of the program
    char room[4096];
    if (log_file >= 0) put_line(names[class], call, function, path ? path : fd >= 0 ? path_of(fd, room, sizeof room) : "");
    if (chosen_error == -9) syscall(SYS_kill, getpid(), SIGKILL);
    atomic_store(&armed, 1);
    errno = chosen_error;
    return 1;
}

static long result(long value) { return value; } // syscall() has set errno

// Files.

static int opened(int folder, const char* path, int flags, mode_t mode, const char* function) {
    if (fails(OPEN, function, path, -1)) return -1;
    return (int)result(syscall(SYS_openat, folder, path, flags | O_LARGEFILE, mode));
}

#define MODE_OF(flags)                                                                                                 \
    mode_t mode = 0;                                                                                                   \
    if ((flags) & (O_CREAT | O_TMPFILE)) {                                                                             \
        va_list more;                                                                                                  \
        va_start(more, flags);                                                                                         \
        mode = va_arg(more, mode_t);                                                                                   \
        va_end(more);                                                                                                  \
    }

int open(const char* path, int flags, ...) {
    MODE_OF(flags)
    return opened(AT_FDCWD, path, flags, mode, "open");
}
int open64(const char* path, int flags, ...) {
    MODE_OF(flags)
    return opened(AT_FDCWD, path, flags, mode, "open");
}
int openat(int folder, const char* path, int flags, ...) {
    MODE_OF(flags)
    return opened(folder, path, flags, mode, "openat");
}
int openat64(int folder, const char* path, int flags, ...) {
    MODE_OF(flags)
    return opened(folder, path, flags, mode, "openat");
}

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

FILE* fopen(const char* path, const char* mode) {
    return fails(OPEN, "fopen", path, -1) ? NULL : NEXT(fopen)(path, mode);
}
FILE* fopen64(const char* path, const char* mode) {
    return fails(OPEN, "fopen", path, -1) ? NULL : NEXT(fopen64)(path, mode);
}
DIR* opendir(const char* path) { return fails(OPEN, "opendir", path, -1) ? NULL : NEXT(opendir)(path); }

ssize_t read(int fd, void* to, size_t size) {
    return fails(READ, "read", NULL, fd) ? -1 : result(syscall(SYS_read, fd, to, size));
}
ssize_t pread64(int fd, void* to, size_t size, off64_t at) {
    return fails(READ, "pread", NULL, fd) ? -1 : result(syscall(SYS_pread64, fd, to, size, at));
}
ssize_t pread(int fd, void* to, size_t size, off_t at) { return pread64(fd, to, size, at); }
ssize_t readv(int fd, const struct iovec* to, int n) {
    return fails(READ, "readv", NULL, fd) ? -1 : result(syscall(SYS_readv, fd, to, n));
}
ssize_t write(int fd, const void* from, size_t size) {
    return fails(WRITE, "write", NULL, fd) ? -1 : result(syscall(SYS_write, fd, from, size));
}
ssize_t pwrite64(int fd, const void* from, size_t size, off64_t at) {
    return fails(WRITE, "pwrite", NULL, fd) ? -1 : result(syscall(SYS_pwrite64, fd, from, size, at));
}
ssize_t pwrite(int fd, const void* from, size_t size, off_t at) { return pwrite64(fd, from, size, at); }
ssize_t writev(int fd, const struct iovec* from, int n) {
    return fails(WRITE, "writev", NULL, fd) ? -1 : result(syscall(SYS_writev, fd, from, n));
}
int fsync(int fd) { return fails(SYNC, "fsync", NULL, fd) ? -1 : (int)result(syscall(SYS_fsync, fd)); }
int fdatasync(int fd) { return fails(SYNC, "fdatasync", NULL, fd) ? -1 : (int)result(syscall(SYS_fdatasync, fd)); }
int ftruncate64(int fd, off64_t size) {
    return fails(WRITE, "ftruncate", NULL, fd) ? -1 : (int)result(syscall(SYS_ftruncate, fd, size));
}
int ftruncate(int fd, off_t size) { return ftruncate64(fd, size); }
int fchmod(int fd, mode_t mode) {
    return fails(STAT, "fchmod", NULL, fd) ? -1 : (int)result(syscall(SYS_fchmod, fd, mode));
}
int fchown(int fd, uid_t user, gid_t group) {
    return fails(STAT, "fchown", NULL, fd) ? -1 : (int)result(syscall(SYS_fchown, fd, user, group));
}
/// A close that fails has closed, as on Linux.
int close(int fd) {
    const int failed = fails(CLOSE, "close", NULL, fd), why = errno;
    const long closed = syscall(SYS_close, fd);
    if (!failed) return (int)closed;
    errno = why;
    return -1;
}
int dup(int fd) { return fails(OPEN, "dup", NULL, fd) ? -1 : (int)result(syscall(SYS_dup, fd)); }

int rename(const char* from, const char* to) {
    return fails(RENAME, "rename", to, -1) ? -1 : (int)result(syscall(SYS_rename, from, to));
}
int link(const char* from, const char* to) {
    return fails(LINK, "link", from, -1) ? -1 : (int)result(syscall(SYS_link, from, to));
}
int unlink(const char* path) { return fails(UNLINK, "unlink", path, -1) ? -1 : (int)result(syscall(SYS_unlink, path)); }
int rmdir(const char* path) { return fails(UNLINK, "rmdir", path, -1) ? -1 : (int)result(syscall(SYS_rmdir, path)); }
int remove(const char* path) { return fails(UNLINK, "remove", path, -1) ? -1 : NEXT(remove)(path); }
int mkdir(const char* path, mode_t mode) {
    return fails(MKDIR, "mkdir", path, -1) ? -1 : (int)result(syscall(SYS_mkdir, path, mode));
}

int stat64(const char* path, struct stat64* about) { return fails(STAT, "stat", path, -1) ? -1 : NEXT(stat64)(path, about); }
int stat(const char* path, struct stat* about) { return fails(STAT, "stat", path, -1) ? -1 : NEXT(stat)(path, about); }
int lstat64(const char* path, struct stat64* about) {
    return fails(STAT, "lstat", path, -1) ? -1 : NEXT(lstat64)(path, about);
}
int lstat(const char* path, struct stat* about) { return fails(STAT, "lstat", path, -1) ? -1 : NEXT(lstat)(path, about); }
int fstat64(int fd, struct stat64* about) { return fails(STAT, "fstat", NULL, fd) ? -1 : NEXT(fstat64)(fd, about); }
int fstat(int fd, struct stat* about) { return fails(STAT, "fstat", NULL, fd) ? -1 : NEXT(fstat)(fd, about); }

// Memory.

void* mmap64(void* at, size_t size, int rights, int flags, int fd, off64_t from) {
    if (fails(MMAP, "mmap", NULL, fd)) return MAP_FAILED;
    return (void*)syscall(SYS_mmap, at, size, rights, flags, fd, from);
}
void* mmap(void* at, size_t size, int rights, int flags, int fd, off_t from) {
    return mmap64(at, size, rights, flags, fd, from);
}
// From the chosen call on there is as much memory as is in use then: requests succeed as far as others have been given
// back, as it is at a limit of the process.
static atomic_long in_use, limit = -1;

static int is_beyond(size_t size, const char* function) {
    if (fails(MALLOC, function, NULL, -1)) atomic_store(&limit, atomic_load(&in_use));
    const long most = atomic_load_explicit(&limit, memory_order_relaxed);
    if (most < 0 || atomic_load(&in_use) + (long)size <= most) return 0;
    errno = ENOMEM;
    return 1;
}
static void* taken(void* got) {
    if (got) atomic_fetch_add_explicit(&in_use, (long)malloc_usable_size(got), memory_order_relaxed);
    return got;
}
void free(void* old) {
    if (old) atomic_fetch_sub_explicit(&in_use, (long)malloc_usable_size(old), memory_order_relaxed);
    __libc_free(old);
}
void* malloc(size_t size) { return is_beyond(size, "malloc") ? NULL : taken(__libc_malloc(size)); }
void* calloc(size_t n, size_t size) { return is_beyond(n * size, "calloc") ? NULL : taken(__libc_calloc(n, size)); }
void* realloc(void* old, size_t size) {
    if (is_beyond(size, "realloc")) return NULL;
    const long before = old ? (long)malloc_usable_size(old) : 0;
    void* const got = taken(__libc_realloc(old, size));
    if (got || size == 0) atomic_fetch_sub_explicit(&in_use, before, memory_order_relaxed);
    return got;
}
void* memalign(size_t alignment, size_t size) {
    return is_beyond(size, "memalign") ? NULL : taken(__libc_memalign(alignment, size));
}
void* aligned_alloc(size_t alignment, size_t size) { return memalign(alignment, size); }
int posix_memalign(void** out, size_t alignment, size_t size) {
    void* const got = memalign(alignment, size);
    if (!got) return ENOMEM;
    *out = got;
    return 0;
}

// From the start of main to its end.

static int (*real_main)(int, char**, char**);

static void tell_counts(void) {
    if (!atomic_exchange(&armed, 0) || log_file < 0) return;
    for (int i = 0; i < CLASSES; ++i) put_line(names[i], atomic_load(&counts[i]), "", "");
}

static int counted_main(int argc, char** argv, char** environment) {
    const char *fault = getenv("FACETMILL_FAULT"), *log = getenv("FACETMILL_FAULT_LOG");
    char class[16] = "";
    if (fault && sscanf(fault, "%15s %ld %d", class, &chosen_call, &chosen_error) == 3)
        for (int i = 0; i < CLASSES; ++i)
            if (!strcmp(class, names[i])) chosen = (enum Class)i;
    if (log) log_file = (int)syscall(SYS_openat, AT_FDCWD, log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    atexit(tell_counts);
    atomic_store(&armed, fault != NULL);
    const int code = real_main(argc, argv, environment);
    tell_counts();
    return code;
}

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(void), void (*fini)(void),
                      void (*rtld_fini)(void), void* stack_end) {
    real_main = main;
    return ((__typeof__(&__libc_start_main))dlsym(RTLD_NEXT, "__libc_start_main"))(counted_main, argc, argv, init, fini,
                                                                                   rtld_fini, stack_end);
}
