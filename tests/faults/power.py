"""What a loss of power may leave, from the trace of a run's calls (inject.c).

The model is that of a file system that keeps names in the order in which they changed, and whatever of a file's bytes,
until it is told to wait: at any moment names may be as they are after any call between the last fsync and now, and the
bytes of a file count only when an fsync of it came after its last write. So a file must not get its name before its
bytes are on the disk, no file that has its name may be written to, and the names must be on the disk at the end.
"""

import fnmatch
import os
import re

TEMPORARY = re.compile(r"^\.(?P<of>.*)\.facetmill-\d+~$")
WRITES = {"write", "writev", "pwrite", "ftruncate"}
SYNCS = {"fsync", "fdatasync"}


def problems(trace, folder, state=()):
    """What may be lost at which call. state: patterns of files that are appended to and say what is done."""
    unsynced = set()  # temporaries with bytes that may be lost
    new_names = {}  # files that have got their names since the folder was synced
    found = []
    for number, (call, path) in enumerate(trace, 1):
        name, parent = os.path.basename(path), os.path.dirname(path)
        relative = os.path.relpath(path, folder)
        if relative.startswith(".."):
            continue
        is_state = any(fnmatch.fnmatch(relative.removesuffix(".part"), pattern) for pattern in state)
        if call in WRITES and is_state:
            found += [f"call {number}: {relative} says what is done before {new} is" for new in new_names]
        elif call in WRITES and TEMPORARY.match(name):
            unsynced.add(path)
        elif call in WRITES:
            found.append(f"call {number}: {relative} is written in place")
        elif call in SYNCS:
            unsynced.discard(path)
            new_names = {new: where for new, where in new_names.items() if where != path}
        elif call == "rename" and not is_state:
            of = {t for t in unsynced if os.path.dirname(t) == parent and TEMPORARY.match(os.path.basename(t))["of"] == name}
            found += [f"call {number}: {relative} gets its name before its bytes are on the disk" for _ in of]
            unsynced -= of
            new_names[relative] = parent
    return found + [f"at the end the name of {new} may be lost" for new in new_names]
