"""facetmill as it is found on PATH, so that actions depend on it: another version makes everything again."""

def _facetmill_on_path(context):
    context.symlink(context.which("facetmill"), "facetmill")
    context.file("BUILD.bazel", 'exports_files(["facetmill"])')

facetmill_on_path = repository_rule(implementation = _facetmill_on_path, environ = ["PATH"], local = True)
