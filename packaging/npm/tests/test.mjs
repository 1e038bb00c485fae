// In a project with the packed packages installed: node test.mjs
import assert from 'node:assert/strict';
import { execFileSync, spawnSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import facetmill, { diff, FacetmillError, info, pipe, run, stages } from 'facetmill';

const before = process.env.FACETMILL;
const seen = [];
const cube = await pipe(['generate', 'cube', '!', 'split', 'midpoint', '!', 'write', 'a cube.stl'],
    { onProgress: (p) => seen.push([p.name, p.done]) });
assert(cube.passed);
assert.equal(cube.stages[1].after.faces, (await info('a cube.stl')).faces);
assert.deepEqual(seen.filter(([, done]) => !done).map(([name]) => name), ['generate', 'split', 'write']);
assert((await diff('a cube.stl', 'a cube.stl')).same);
assert((await stages()).some((stage) => stage.name === 'simplify'));
assert((await run({ facetmill: 1, stages: [{ generate: 'cube' }, { write: 'c.glb' }] }, { outputDir: 'out' })).passed);
await assert.rejects(pipe('load nothing.glb ! write x.glb'),
    (error) => error instanceof FacetmillError && error.id === 'E-FILE' && error.exitCode === 3);
await assert.rejects(pipe('generate cube ! validate --euler 0'), (error) => error.id === 'E-CHECK' && !error.report.passed);
assert.equal((await pipe('generate cube ! validate --euler 0', { check: false })).exit_code, 1);
const required = createRequire(import.meta.url)('facetmill');
assert.equal(required.pipe, facetmill.pipe);
const npx = (...args) => execFileSync('npx', ['facetmill', ...args], { encoding: 'utf8' });
assert.match(npx('--version'), /^facetmill /);
assert.throws(() => execFileSync('npx', ['facetmill', 'info', 'nothing'], { stdio: 'pipe' }), (error) => error.status === 3);
process.env.FACETMILL = '/nowhere/facetmill';
await assert.rejects(stages(), /ENOENT/);
process.env.FACETMILL = path.resolve('facetmill-of-z');  // an ELF file for IBM z
fs.writeFileSync(process.env.FACETMILL, Buffer.from('7f454c46020101'.padEnd(32, '0') + '02001600'.padEnd(96, '0'), 'hex'));
await assert.rejects(stages(), /is the file for another system: install facetmill-/);
fs.writeFileSync(process.env.FACETMILL, '#!/bin/sh\n', { mode: 0o644 });
await assert.rejects(stages(), /EACCES.*chmod [+]x/);
delete process.env.FACETMILL;
if (!before) {  // with packages: without the one for this machine
  const other = process.arch === 'x64' ? 'arm64' : 'x64', place = (arch) => `node_modules/facetmill-linux-${arch}`;
  fs.renameSync(place(process.arch), place(other));
  const failed = spawnSync('npx', ['facetmill', '--version'], { encoding: 'utf8' });
  fs.renameSync(place(other), place(process.arch));
  assert.deepEqual([failed.status, failed.stderr.split(':')[0]],
      [70, `facetmill-linux-${other} is installed, and this machine needs facetmill-linux-${process.arch}`]);
}
console.log('all passed');
