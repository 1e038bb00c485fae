#pragma once
// The help and manual texts of validate.

namespace facetmill::help::validate {

inline constexpr const char* about =
    R"(Checks the mesh. Each given property is an assertion, and a failed assertion fails the run.)";

inline constexpr const char* details =
    R"(You give each property a bound: a value (euler: 2), true or false (closed: true), or a range (faces:
{max: 5000}, min_angle: {min: 5deg}).
The option `for` adds the assertions for a purpose, and your own values take precedence.
Without any property or purpose, the mesh must be closed, edge-manifold, vertex-manifold, oriented,
free of degenerate faces, and not empty.

After `write`, the stage reads back and checks each file that holds the current scene, in the units
and axes of the scene.
The stage checks the scene itself if a stage changed it after `write`, or if no file holds all parts.
For tilesets and for meshes in cells, it also checks the scene and not the file.
The report names the file of each check.
The limits bytes, draw_calls and texture_pixels apply to each file written before, also in branches
and in foreach.
They need a `write` before them (E-LIMITS).

After a check with a purpose (for) passes, `write` keeps the same scene fit for it.
It repairs faults that rounding to 32-bit floats causes, and reads the file back.
The run fails (exit 1) if the file does not fit.

All assertions are checked.
For each failure, the stage reports the number of faulty elements and the positions of the first or
worst.
Failures of a measure list only faces beyond the bound.
Angles are in degrees.
The mesh passes on unchanged.

A baseline lets you introduce checks on existing assets.
The option `baseline: known.json` with update_baseline (or run --update-baseline) writes the current
failures to the file.
Later runs without update_baseline waive these known failures, and new failures fail the run.

A failure is identified by its check, its part and its locations.
Edges, faces, pairs of faces and vertices are identified by the exact coordinates of their vertices
in the part's local space.
Their numbers and order do not matter.
Components are identified by their lowest vertex (smallest x, then y, then z).
A new fault therefore fails even if an old one was fixed, and so does a fault on a face that moved.

A failure without locations, such as a count, is waived unless its value moves farther from the
bound.
Limits on names list the names as locations.
The report lists known failures that no longer occur.
A baseline stores up to 50000 locations per check.
Beyond that, it stores a sample and one combined key, which detects changed locations even if their
number is the same.

The properties `self_intersections` and `touching` are separate counts.
Faces intersect if they meet in the interior of a face, or pass through each other at their edges.
Faces touch if they meet only at edges and corners.
For example, clean leaves touching faces when it separates an edge with four faces.
Slicers accept touching faces, and so does `for: printing`.
Use `touching: 0` to forbid them.

The assertion `euler: 2` is a common test for closed surfaces, but it is only valid for one
component of genus 0.
A closed component of genus g has V - E + F = 2 - 2g, and components add up.
Use `closed: true` to test for closed surfaces in every case.

Source: P. Bourke, 'Eulers number and closed surfaces' (1997).)";

} // namespace facetmill::help::validate
