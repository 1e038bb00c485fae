// node validate.mjs MODULES FILE...
// Runs the Khronos validator (installed into MODULES/node_modules by setup.sh) on each file. Prints every error and
// warning; fails when there is an error.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, dirname, join, resolve } from 'node:path';

const [modules, ...files] = process.argv.slice(2);
const validator = createRequire(resolve(modules, 'node_modules', 'x.js'))('gltf-validator');
const levels = ['error', 'warning'];
let failed = 0;
for (const file of files) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)), {
    uri: basename(file),
    maxIssues: 100,
    externalResourceFunction: (uri) =>
      Promise.resolve(new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))))),
  });
  for (const { code, severity, message, pointer } of report.issues.messages)
    if (severity <= 1) console.log(`${file}: ${levels[severity]} ${code} at ${pointer}: ${message}`);
  failed += report.issues.numErrors > 0 ? 1 : 0;
}
console.log(`${files.length} files, ${failed} with errors`);
process.exit(failed > 0 ? 1 : 0);
