# One-liners, the same in bash, zsh and fish. Stages are separated by ! or +; what a shell might expand is quoted.

# A scan becomes a small GLB.
facetmill pipe load ../data/nefertiti.ply --unit mm ! simplify 10% ! write web.glb --draco

# The same with plus signs, and without a percent sign.
facetmill pipe load ../data/nefertiti.ply --unit mm + simplify 10pct + write plus.glb --draco

# Cut, close the cut, and refuse to write anything that is not closed.
facetmill pipe load ../data/nefertiti.ply --unit mm ! clip 'y=-150' --cap ! simplify 5% --ensure.closed ! write bust.stl

# Three levels of detail.
facetmill pipe load ../data/nefertiti.ply --unit mm ! foreach lod=50%,20%,5% '[' simplify '@{lod}' ! write 'lod@{lod.index}.glb' ']'

# Two branches from one scene.
facetmill pipe load ../data/nefertiti.ply --unit mm ! branch smooth '[' relax 1 ! write smooth.ply ']' rough '[' crumple --grid 1 --amplitude 0.05% ! write rough.ply ']'

# A check: the exit code is 1 if the mesh is not closed.
facetmill pipe load ../data/nefertiti.ply ! validate --closed --euler 2

# Through pipes.
cat ../data/nefertiti.ply | facetmill pipe --quiet load - --unit mm ! simplify 2% ! write - --format ply | facetmill info - > info.txt

# Save the pipeline for later.
facetmill pipe --save kept.yaml load ../data/nefertiti.ply --unit mm ! simplify 2% ! write kept.glb
facetmill run kept.yaml

# Every scan of a folder, in one process; a second time nothing is left to do.
facetmill batch scan-to-web --input '../data/*.ply' -D unit=mm -D keep=2% --output-dir many
