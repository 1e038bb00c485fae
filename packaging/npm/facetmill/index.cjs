// facetmill from Node: runs pipelines and returns their reports. index.d.ts has the types.
const { spawn } = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const readline = require('node:readline');

/** A run that did not pass: id, place, hint, exitCode and, where one was made, report. */
class FacetmillError extends Error {
  constructor(message, details) {
    super(message);
    this.name = 'FacetmillError';
    Object.assign(this, { id: '', place: '', hint: '', exitCode: 0, report: undefined }, details);
  }
}

const systems = ['linux-x64', 'linux-arm64', 'win32-x64'];
const machines = { 0x3e: 'x64', 0xb7: 'arm64' };  // e_machine of an ELF file

function packaged(system) {
  try {
    return require.resolve(`facetmill-${system}/bin/facetmill${system.startsWith('win32') ? '.exe' : ''}`);
  } catch {
    return undefined;
  }
}

function missing(system) {
  const published = `facetmill-${system}` in require('./package.json').optionalDependencies;
  const other = systems.find(packaged), built = 'or set FACETMILL to a program that you have built';
  if (!published) return `facetmill has no program for ${system} yet: use Linux or Windows on x64, ${built}`;
  if (other) return `facetmill-${other} is installed, and this machine needs facetmill-${system}: ` +
      'run npm install here, in place of a copied node_modules';
  return `facetmill has no program for ${system} here: install the package facetmill-${system} ` +
      `(npm leaves it out with --no-optional), ${built}`;
}

/** Throws if the file is a program for another architecture, which a shell would run as a script. */
function checkArchitecture(program) {
  const header = Buffer.alloc(20);
  let file;
  try {
    file = fs.openSync(program);
  } catch {
    return;  // starting it says why
  }
  fs.readSync(file, header, 0, 20, 0);
  fs.closeSync(file);
  const machine = machines[header.readUInt16LE(18)] ?? 'another system';
  if (header.toString('latin1', 0, 4) !== '\x7fELF' || machine === process.arch) return;
  const emulator = { x64: 'x86_64', arm64: 'aarch64' }[machine];
  if (fs.existsSync(`/proc/sys/fs/binfmt_misc/qemu-${emulator}`)) return;
  throw new FacetmillError(`${program} is the file for ${machine}: install facetmill-${process.platform}-${process.arch}`);
}

/** The path of the program: $FACETMILL, or that of the package for this system. */
function executable() {
  const system = `${process.platform}-${process.arch}`, program = process.env.FACETMILL || packaged(system);
  if (!program) throw new FacetmillError(missing(system));
  checkArchitecture(program);
  return program;
}

/** The error of a program that could not be started. */
function unstarted(error) {
  if (error.name === 'AbortError') return error;
  const hint = error.code === 'EACCES' ? ': chmod +x it, or install it in a file system that is not mounted noexec' : '';
  return new FacetmillError(`facetmill cannot be started: ${error.message}${hint}`);
}

function call(args, { input, cwd, onProgress, signal } = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(executable(), args, { cwd, signal, stdio: [input === undefined ? 'ignore' : 'pipe', 'pipe', 'pipe'] });
    const output = [], errors = [], others = [];
    child.stdout.on('data', (chunk) => output.push(chunk));
    readline.createInterface({ input: child.stderr }).on('line', (line) => {
      let event;
      try {
        event = JSON.parse(line);
      } catch {
        others.push(line);
        return;
      }
      if (event.level === 'error') errors.push(event);
      if (!onProgress) return;
      if (event.event === 'begin') onProgress({ name: event.name, number: event.number, of: event.of, done: false });
      if (event.event === 'stage') onProgress({ name: event.name, done: true, faces: event.faces_after });
    });
    if (input !== undefined) {
      child.stdin.on('error', () => {});  // a program that ends early does not read all of it
      child.stdin.end(input);
    }
    child.on('error', (error) => reject(unstarted(error)));
    child.on('close', (code, ended) => resolve({ code: code ?? 128 + os.constants.signals[ended],
      output: Buffer.concat(output).toString('utf8'), errors, others: others.join('\n') }));
  });
}

function failure({ code, errors, others }, report) {
  const first = errors[0];
  if (!first) return new FacetmillError(others || `facetmill ended with exit code ${code}`, { exitCode: code, report });
  const place = ['file', 'line', 'column'].filter((key) => key in first).map((key) => first[key]).join(':');
  return new FacetmillError(`${place ? place + ': ' : ''}${first.id}: ${first.message}` + (first.hint ? ` (hint: ${first.hint})` : ''),
      { id: first.id, place, hint: first.hint ?? '', exitCode: code, report });
}

async function reported(args, options, input) {
  const folder = await fs.promises.mkdtemp(path.join(os.tmpdir(), 'facetmill-'));
  try {
    const file = path.join(folder, 'report.json');
    const verbose = options.onProgress ? ['-v'] : [];
    const done = await call([args[0], '--log', 'json', ...verbose, '--report', file, ...(options.options ?? []), ...args.slice(1)],
        { ...options, input });
    const report = fs.existsSync(file) ? JSON.parse(await fs.promises.readFile(file, 'utf8')) : undefined;
    if (!report || (done.code !== 0 && options.check !== false)) throw failure(done, report);
    return report;
  } finally {
    await fs.promises.rm(folder, { recursive: true, force: true });
  }
}

function definitions(params) {
  return Object.entries(params ?? {}).flatMap(([name, value]) =>
    ['-D', `${name}=${typeof value === 'object' || typeof value === 'boolean' ? JSON.stringify(value) : value}`]);
}

/** Runs a pipeline: a YAML file, the name of a built-in pipeline, or an object with the keys of such a file. */
function run(pipeline, options = {}) {
  const args = ['run', ...(options.outputDir ? ['--output-dir', options.outputDir] : []), ...definitions(options.params)];
  return typeof pipeline === 'string' ? reported([...args, pipeline], options)
                                      : reported([...args, '-'], options, JSON.stringify(pipeline));
}

/** Runs stages: pipe(['load', 'a.stl', '!', 'clean', '!', 'write', 'a.glb']), or the same in one text without quotes. */
function pipe(stages, options = {}) {
  return reported(['pipe', ...(typeof stages === 'string' ? stages.trim().split(/\s+/) : stages)], options);
}

async function json(args, allowed = [0]) {
  const done = await call(args);
  if (!allowed.includes(done.code)) throw failure(done);
  return JSON.parse(done.output);
}

/** The properties of a mesh file. */
const info = (file, options = []) => json(['info', '--json', '--log', 'json', ...options, file]);
/** Compares two mesh files: `same` says whether they agree. */
const diff = (a, b, options = []) => json(['diff', '--json', '--log', 'json', ...options, a, b], [0, 1]);
/** All stages with their options. */
const stages = () => json(['stages', '--json']);

module.exports = { FacetmillError, diff, executable, info, pipe, run, stages, unstarted };
