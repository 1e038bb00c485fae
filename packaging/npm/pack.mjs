// pack.mjs OUT EXECUTABLE SYSTEM [EXECUTABLE SYSTEM]: packs the package facetmill and one for each program, whose system
// is linux-x64, linux-arm64 or win32-x64.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const here = path.dirname(fileURLToPath(import.meta.url)), top = path.join(here, '../..');
const version = fs.readFileSync(path.join(top, 'VERSION'), 'utf8').trim();
const [out, ...programs] = process.argv.slice(2);
if (!out || programs.length === 0 || programs.length % 2) {
  console.error('usage: pack.mjs OUT EXECUTABLE SYSTEM [EXECUTABLE SYSTEM]');
  process.exit(2);
}
const common = { version, license: 'GPL-3.0-or-later', engines: { node: '>=18' } };
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'facetmill-pack-'));

function pack(folder, description) {
  fs.writeFileSync(path.join(folder, 'package.json'), JSON.stringify({ ...description, ...common }, null, 2) + '\n');
  fs.copyFileSync(path.join(top, 'LICENSE'), path.join(folder, 'LICENSE'));
  fs.copyFileSync(path.join(here, 'README.md'), path.join(folder, 'README.md'));
  for (const file of fs.readdirSync(folder, { recursive: true }).map((f) => path.join(folder, f)))  // not those of the umask
    fs.chmodSync(file, fs.statSync(file).isDirectory() || file.includes('/bin/') ? 0o755 : 0o644);
  const name = execFileSync('npm', ['pack', '--silent', '--pack-destination', path.resolve(out), folder], { encoding: 'utf8' });
  console.log(path.join(out, name.trim()));
}

function type(schema, prefix) {
  if (schema.$ref) return prefix + schema.$ref.split('/').pop().replace(/[^A-Za-z0-9]+(.)?/g, (_, c) => (c ?? '').toUpperCase());
  if (schema.anyOf) return schema.anyOf.map((s) => type(s, prefix)).join(' | ');
  if (schema.enum) return schema.enum.map((v) => JSON.stringify(v)).join(' | ');
  if ('const' in schema) return JSON.stringify(schema.const);
  if (schema.type === 'array') return `Array<${type(schema.items ?? {}, prefix)}>`;
  if (schema.type === 'object' && schema.properties) {
    const fields = Object.entries(schema.properties).map(([key, value]) =>
      (value.description ? `/** ${value.description} */ ` : '') +
      `${JSON.stringify(key)}${(schema.required ?? []).includes(key) ? '' : '?'}: ${type(value, prefix)};`);
    return `{\n${fields.join('\n')}\n}`;
  }
  return { object: 'Record<string, any>', integer: 'number', number: 'number', string: 'string', boolean: 'boolean',
           null: 'null' }[schema.type] ?? 'any';
}

function declarations(program) {
  let text = '// Generated from `facetmill schema`.\n';
  for (const [kind, prefix] of [['report', 'Report'], ['info', 'Info'], ['diff', 'Diff']]) {
    const schema = JSON.parse(execFileSync(program, ['schema', kind], { encoding: 'utf8' }));
    for (const [name, value] of Object.entries(schema.$defs ?? {}))
      text += `export type ${type({ $ref: '/' + name }, prefix)} = ${type(value, prefix)};\n`;
    text += `export type ${prefix} = ${type(schema, prefix)};\n`;
  }
  return text;
}

const main = path.join(work, 'facetmill');
fs.cpSync(path.join(here, 'facetmill'), main, { recursive: true });
const optionalDependencies = {};
for (let i = 0; i < programs.length; i += 2) {
  const [program, system] = [programs[i], programs[i + 1]], [platform, cpu] = system.split('-');
  const name = `facetmill-${system}`, folder = path.join(work, name), file = platform === 'win32' ? 'facetmill.exe' : 'facetmill';
  fs.mkdirSync(path.join(folder, 'bin'), { recursive: true });
  fs.copyFileSync(program, path.join(folder, 'bin', file));
  pack(folder, { name, description: `The program of facetmill for ${platform === 'win32' ? 'Windows' : 'Linux'} on ${cpu}`, os: [platform], cpu: [cpu], files: ['bin'] });
  optionalDependencies[name] = version;
  if (system === `${process.platform}-${process.arch}`) fs.writeFileSync(path.join(main, 'reports.d.ts'), declarations(path.resolve(program)));
}
pack(main, {
  name: 'facetmill', description: 'Declarative mesh pipelines that end in checked glTF',
  keywords: ['gltf', 'glb', 'mesh', '3d', 'draco', 'meshopt', 'stl', 'obj', 'vite-plugin'],
  bin: { facetmill: 'bin/facetmill.js' }, main: './index.cjs', types: './index.d.ts',
  exports: { '.': { types: './index.d.ts', import: './index.mjs', require: './index.cjs' }, './vite': './vite.mjs' },
  files: ['bin', 'index.cjs', 'index.mjs', 'index.d.ts', 'reports.d.ts', 'vite.mjs'], optionalDependencies });
fs.rmSync(work, { recursive: true });
