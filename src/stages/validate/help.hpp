#pragma once
// The help and manual texts of validate.

namespace facetmill::help::validate {

inline constexpr const char* about =
    R"(Checks the mesh: each given property is an assertion, and a failed assertion fails the run.)";

inline constexpr const char* details =
    R"(A property is given with a bound: a value (euler: 2), true or false (closed: true), or a range
(faces: {max: 5000}, min_angle: {min: 5deg}). `for` adds the assertions that a purpose needs, except
those that are given. Without properties and purpose, the mesh must be closed, edge-manifold and
vertex-manifold, oriented, free of degenerate faces and not empty. All assertions are checked, and
all failures are listed with evidence: the first (or worst) faces and points at fault (for measures,
only faces beyond the bound) and how many there are. Angles are in degrees. The mesh passes on
unchanged.

After `write`, each file that holds the current scene is read back and judged, in the units and axes of
the scene. If a stage changed the scene after `write`, or no file holds all its parts, the scene itself
is judged. Tilesets and meshes in cells are judged as scenes. The report names the file of each check.
Limits of bytes, draw_calls and texture_pixels apply to each file written before, also in branches and
in foreach, and need a `write` before them (E-LIMITS).

If a check with a purpose (for) passes, `write` keeps the promise for the same scene: it repairs what
32-bit floats spoil, reads the file back, and fails the run (exit 1) if the file does not fit.

To introduce a check on existing assets, `baseline: known.json` with update_baseline (or run
--update-baseline) writes what fails today. From then on, without update_baseline, those failures
are waived (known), and new ones fail. A failure is identified by its check, its part and its
locations: edges, faces, pairs of faces and vertices by the exact coordinates of their vertices in
the part's local space, whatever their numbers and order, and components by their lowest vertex (x
first, then y, z). So a new fault in place of a fixed one fails, and so do faults on faces that
moved. A failure without locations (counts, except the names of a limit) is waived as long as the
value has not moved farther from the bound. The run reports known failures that no longer occur. A
baseline lists up to 50000 locations per check. Beyond that it stores a sample and one combined key,
by which it still notices when as many locations remain but some of them are different.

`self_intersections` and `touching` are separate counts. Faces intersect when they meet inside one
of them or pass through each other at their edges; where they meet only at edges and corners, they
touch, for example after clean has separated an edge with four faces. Slicers accept that, and so
does `for: printing`; `touching: 0` forbids it.

`euler: 2` is a common test for a closed surface, but it is valid only for a single component of
genus 0: V - E + F is 2 - 2g for a closed component of genus g, and components add up. Use `closed:
true` to test closedness in every case.

Source: P. Bourke, 'Eulers number and closed surfaces' (1997).)";

} // namespace facetmill::help::validate
