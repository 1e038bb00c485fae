// node no_new_errors.mjs MODULES EXECUTABLE PATH...
// Asserts that no output has more errors than its input: reads every .gltf and .glb of the paths, writes it in several
// ways, and counts the errors of the Khronos validator (installed into MODULES/node_modules by setup.sh) on both sides.
// A path may be a folder, or @LIST for a file with one path a line.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, dirname, join, resolve } from 'node:path';

const ways = {
  plain: ['write'],
  meshopt: ['write', '--meshopt'],
  quantize: ['write', '--quantize'],
  draco: ['write', '--draco'],
  optimize: ['optimize', '--drop_attributes', '--palette', '!', 'write', '--meshopt'],
  instance: ['optimize', '--instance', '--instance_min', '2', '!', 'write'],
  expand: ['write', '--quantize'],
  merge: ['merge', '!', 'write'],
  bake: ['transform', '--scale', '2', '--bake', '!', 'write', '--meshopt'],
  simplify: ['simplify', '50%', '!', 'write'],
  levels: ['simplify', '--lods', '100%,50%', '!', 'write', '--lods'],
};

const [modules, executable, ...paths] = process.argv.slice(2);
const validator = createRequire(resolve(modules, 'node_modules', 'x.js'))('gltf-validator');

async function errors_of(file) {
  const found = new Map();
  try {
    const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
      uri: basename(file),
      maxIssues: 0,
      externalResourceFunction: async (uri) =>
        new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri)))),
    });
    for (const { code, severity } of report.issues.messages)
      if (severity === 0) found.set(code, (found.get(code) ?? 0) + 1);
  } catch {
    found.set('UNREADABLE', 1);
  }
  return found;
}

function files_below(path) {
  if (path.startsWith('@')) return readFileSync(path.slice(1), 'utf8').split('\n').filter(Boolean).flatMap(files_below);
  if (!statSync(path).isDirectory()) return /\.(gltf|glb)$/i.test(path) ? [path] : [];
  return readdirSync(path).sort().flatMap((name) => files_below(join(path, name)));
}

const folder_of_outputs = mkdtempSync(join(tmpdir(), 'no-new-errors-'));
const sum = (found) => [...found.values()].reduce((a, b) => a + b, 0);
let written = 0, refused = 0, worse = 0, crashed = 0;
for (const file of paths.flatMap(files_below)) {
  const before = await errors_of(file);
  for (const [way, stages] of Object.entries(ways)) {
    const output = join(folder_of_outputs, 'o.glb');
    if (existsSync(output)) rmSync(output);
    const at = stages.lastIndexOf('write') + 1;
    const load = way === 'expand' ? ['load', file, '--instances', 'expand'] : ['load', file];
    const line = ['pipe', ...load, '!', ...stages.slice(0, at), output, ...stages.slice(at)];
    try {
      execFileSync(executable, line, { stdio: 'ignore', timeout: 60000 });
    } catch (e) {
      if (e.status === null || e.status >= 70) {
        ++crashed;
        console.log(`${file}: ${way}: ends with ${e.status ?? e.signal}`);
      }
    }
    if (!existsSync(output)) {
      ++refused;
      continue;
    }
    ++written;
    const after = await errors_of(output);
    if (sum(after) <= sum(before)) continue;
    ++worse;
    console.log(`${file}: ${way}: ${sum(before)} errors before, after: ${[...after].join(' ')}`);
  }
}
rmSync(folder_of_outputs, { recursive: true });
console.log(`${written} outputs, ${worse} with more errors than the input; ${refused} not written, ${crashed} crashes`);
process.exit(worse + crashed > 0 ? 1 : 0);
